#pragma once

#include <mrpt/poses/CPose3D.h>
#include <omnimapper/grid/GridMap.h>
#include <omnimapper/map/Places.h>

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace omnimapper::ros_export {

inline constexpr char kMapFrame[] = "map", kBaseFrame[] = "base_link";

/// A pose of the base in the map; the time is in nanoseconds since 1970.
using TimedPose = std::pair<std::uint64_t, mrpt::poses::CPose3D>;

/// Messages as CDR, in the frame of the map. Times are in nanoseconds since 1970.
std::string transformMessage(const TimedPose& pose);           ///< tf2_msgs/TFMessage
std::string odometryMessage(const TimedPose& pose);            ///< nav_msgs/Odometry, without speeds
std::string pathMessage(const std::vector<TimedPose>& poses);  ///< nav_msgs/Path, with the time of the first pose
std::string gridMessage(std::uint64_t time, const grid::GridMap& grid);  ///< nav_msgs/OccupancyGrid: -1, 0, 100
/// visualization_msgs/MarkerArray: for each place that has an extent its edges as a list of lines and its points as
/// spheres, and its caption, or else its label, as a text above it.
std::string markersMessage(std::uint64_t time, const std::vector<map::Place>& places);

}  // namespace omnimapper::ros_export
