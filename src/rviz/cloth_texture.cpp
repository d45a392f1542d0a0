// The images that the cloth is covered with.
#include "cloth_tearing/rviz/cloth_texture.h"

#include <OgreImage.h>
#include <OgreResourceGroupManager.h>
#include <OgreTextureManager.h>
#include <ros/package.h>

#include <QFileInfo>
#include <QImageReader>
#include <algorithm>
#include <cmath>

#include "cloth_tearing/core/refusal.h"

namespace cloth_tearing
{

namespace
{

constexpr int MOST_PIXELS = 4096;  // along a side: what any graphics card takes
constexpr int STRAIN_COLORS = 256;

const std::string PACKAGE = "package://";
const std::string FILE_SCHEME = "file://";

bool startsWith(const std::string& text, const std::string& start)
{
  return text.compare(0, start.size(), start) == 0;
}

std::string toPath(const std::string& location)
{
  if (startsWith(location, PACKAGE))
  {
    const std::size_t slash = std::min(location.find('/', PACKAGE.size()), location.size());
    const std::string package = location.substr(PACKAGE.size(), slash - PACKAGE.size());
    const std::string folder = ros::package::getPath(package);
    if (folder.empty())
    {
      throw cloth::Refusal("there is no package \"" + package + "\", named by " + location);
    }
    return folder + location.substr(slash);
  }
  const std::string path =
      startsWith(location, FILE_SCHEME) ? location.substr(FILE_SCHEME.size()) : location;
  if (path.empty() || path.front() != '/')
  {
    throw cloth::Refusal("\"" + location + "\" must be /absolute/path or package://PACKAGE/PATH");
  }
  return path;
}

}  // namespace

QImage readImage(const std::string& location)
{
  const QString path = QString::fromStdString(toPath(location));
  if (!QFileInfo(path).isFile())
  {
    throw cloth::Refusal("there is no file " + path.toStdString());
  }
  QImageReader reader(path);
  reader.setDecideFormatFromContent(true);
  const QSize size = reader.size();
  if (std::max(size.width(), size.height()) > MOST_PIXELS)
  {
    reader.setScaledSize(size.scaled(MOST_PIXELS, MOST_PIXELS, Qt::KeepAspectRatio));
  }
  const QImage image = reader.read();
  if (image.isNull())
  {
    throw cloth::Refusal(path.toStdString() +
                         " is no image that can be read: " + reader.errorString().toStdString());
  }
  return image;
}

QColor strainColor(double place)
{
  const double white = 1.0 - std::abs(2.0 * place - 1.0);
  const auto mixed = [white](double end) { return white + (1.0 - white) * end; };
  return place < 0.5 ? QColor::fromRgbF(mixed(0.10), mixed(0.25), mixed(0.85))
                     : QColor::fromRgbF(mixed(0.85), mixed(0.10), mixed(0.10));
}

QImage strainImage()
{
  QImage image(STRAIN_COLORS, 1, QImage::Format_RGB32);
  for (int i = 0; i < STRAIN_COLORS; ++i)
  {
    image.setPixelColor(i, 0, strainColor(i / (STRAIN_COLORS - 1.0)));
  }
  return image;
}

Ogre::TexturePtr makeTexture(const std::string& name, const QImage& image)
{
  QImage pixels = image.convertToFormat(QImage::Format_RGBA8888);
  Ogre::Image source;
  source.loadDynamicImage(pixels.bits(), pixels.width(), pixels.height(), 1, Ogre::PF_BYTE_RGBA);
  return Ogre::TextureManager::getSingleton().loadImage(
      name, Ogre::ResourceGroupManager::DEFAULT_RESOURCE_GROUP_NAME, source, Ogre::TEX_TYPE_2D,
      Ogre::MIP_UNLIMITED);
}

}  // namespace cloth_tearing
