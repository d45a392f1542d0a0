// Makes a ClothNode of what the parameter server says, whoever runs it.
#pragma once

#include <ros/node_handle.h>

#include <memory>

#include "cloth_tearing/node/cloth_node.h"

namespace cloth_tearing
{

/// @param node private: its parameters are read, and everything lives in its namespace
/// @throws std::exception that names all wrong parameters, or says why there is no such cloth
std::unique_ptr<ClothNode> makeClothNode(const ros::NodeHandle& node);

}  // namespace cloth_tearing
