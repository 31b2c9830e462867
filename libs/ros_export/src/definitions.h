#pragma once

#include <string>

namespace omnimapper::ros_export {

/// The definition of a type in the form ros2msg: its fields as ROS 2 has them since Humble, then those of the types
/// that it contains. Throws Error(internal) for a type that exportRos() does not write.
std::string definitionOf(const std::string& type);

}  // namespace omnimapper::ros_export
