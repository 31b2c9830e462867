#pragma once

#include <omnimapper/base/Stamp.h>

#include <Eigen/Core>
#include <string>
#include <vector>

namespace omnimapper::calibration {

/// Somebody who points at a known target, as whoever watched the recording noted it.
struct PointedGesture {
  std::string person, target;
  Eigen::Vector3d target_in_base = Eigen::Vector3d::Zero();  ///< [m], where the base stood then
  base::Stamp begin, end;                                    ///< end without stamp: the first 30 skeletons count
  bool is_right_arm = true;
};

/// Number of skeletons of a gesture whose end is not given, as in the thesis.
constexpr std::size_t kFramesOfGesture = 30;

/// Reads the table: columns person, target, x_m, y_m, z_m, begin_s (Unix time); end_s and arm (right or left) may be
/// missing or empty. Throws Error(unreadable_input) with the line if a number is not finite, a time is none, the end is
/// not after the begin, or a target stands at two places that are more than 1 m apart.
std::vector<PointedGesture> readPointedGestures(const std::string& path);

}  // namespace omnimapper::calibration
