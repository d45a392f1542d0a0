// The node as a nodelet: the same class in somebody else's process.
#include <nodelet/nodelet.h>
#include <pluginlib/class_list_macros.hpp>

#include <exception>
#include <memory>

#include "cloth_tearing/node/make_cloth_node.h"

namespace cloth_tearing
{

class ClothNodelet : public nodelet::Nodelet
{
private:
  /// Throws on when there is no such cloth: the manager then answers that it could not be loaded.
  void onInit() override
  {
    try
    {
      cloth_ = makeClothNode(getPrivateNodeHandle());
    }
    catch (const std::exception& error)
    {
      NODELET_FATAL_STREAM(error.what());
      throw;
    }
  }

  std::unique_ptr<ClothNode> cloth_;
};

}  // namespace cloth_tearing

PLUGINLIB_EXPORT_CLASS(cloth_tearing::ClothNodelet, nodelet::Nodelet)
