// Makes a ClothNode of what the parameter server says, whoever runs it.
#include "cloth_tearing/node/make_cloth_node.h"

#include <ros/param.h>

#include <stdexcept>
#include <string>

#include "cloth_tearing/node/params_loader.h"

namespace cloth_tearing
{

std::unique_ptr<ClothNode> makeClothNode(const ros::NodeHandle& node)
{
  XmlRpc::XmlRpcValue tree;
  ros::param::get(node.getNamespace(), tree);
  const LoadedParams loaded = loadParams(tree);
  refuseWrongParams(node.getNamespace(), loaded.problems);
  try
  {
    return std::make_unique<ClothNode>(node, loaded.params);
  }
  catch (const std::exception& error)
  {
    throw std::runtime_error(node.getNamespace() + " cannot build its cloth: " + error.what());
  }
}

}  // namespace cloth_tearing
