// OBJ text of a surface.
#include "cloth_tearing/core/obj_writer.h"

#include <limits>
#include <locale>

namespace cloth
{

void writeObj(std::ostream& out, const Surface& surface, const Vec3d& origin)
{
  const std::locale before = out.imbue(std::locale::classic());
  const bool moved = origin != Vec3d::Zero();
  const std::streamsize precision = out.precision(moved ? std::numeric_limits<double>::max_digits10
                                                        : std::numeric_limits<Real>::max_digits10);
  for (const Vec3& position : surface.position)
  {
    const Vec3d x = position.cast<double>() + origin;
    out << "v " << x.x() << ' ' << x.y() << ' ' << x.z() << '\n';
  }
  out.precision(std::numeric_limits<double>::max_digits10);
  for (const SurfaceTriangle& t : surface.topology->triangles)
  {
    for (const Vec2d& uv : t.uv)
    {
      out << "vt " << uv.x() << ' ' << uv.y() << '\n';
    }
  }
  std::size_t corner = 0;
  for (const SurfaceTriangle& t : surface.topology->triangles)
  {
    out << 'f';
    for (int p : t.particles)
    {
      out << ' ' << p + 1 << '/' << ++corner;
    }
    out << '\n';
  }
  out.precision(precision);
  out.imbue(before);
}

}  // namespace cloth
