#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace omnimapper::ros_export {

/// What exportRos() wrote.
struct Exported {
  std::size_t poses = 0, landmarks = 0;
  bool has_grid = false;
  std::vector<std::string> notes;  ///< sentences about what was left out
};

/// Writes a map as an MCAP file of ROS 2 (messages as CDR, with their definitions), for Foxglove, RViz and rosbag2:
///  - /tf (tf2_msgs/TFMessage): base_link in map, at each pose of the trajectory;
///  - /odometry (nav_msgs/Odometry): the same poses, without speeds;
///  - /path (nav_msgs/Path): all of them in one message;
///  - /map (nav_msgs/OccupancyGrid): grid.yaml beside the map, if there is one;
///  - /landmarks (visualization_msgs/MarkerArray): outlines, lines and points of each landmark with its label; those
///    that moved away are in the namespace "moved".
/// Stamps are those of the poses; the last three topics have one message, with that of the first pose. Frame of the map
/// [m], z up. Poses of sessions that nothing ties to the map are left out, with a note. `map` is the folder of a map,
/// or a map file. Throws Error(unreadable_input) if the map cannot be read or has no key frames or
/// poses outside of the years 1970 to 2038, Error(command_line) if `output` is the file of the map or does not end in
/// .mcap, Error(unwritable_output) or Error(disk_full).
Exported exportRos(const std::string& map, const std::string& output);

}  // namespace omnimapper::ros_export
