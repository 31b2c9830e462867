#pragma once

#include <mrpt/obs/CAction.h>
#include <mrpt/poses/CPose3D.h>
#include <omnimapper/geometry/Se3.h>

#include <cstdint>
#include <optional>
#include <string>

namespace omnimapper::source {

/// What an MRPT action says about the base's motion.
struct ActionMotion {
  std::string origin;  ///< how it was estimated: "" for odometry, "scan_matching" or "visual"
  geometry::Se3 begin_from_end;
  geometry::Matrix6d covariance = geometry::Matrix6d::Zero();  ///< tangent of Se3
  std::uint64_t actions = 1;                                   ///< how many are joined in it
};

/// Empty for no action or one that is no movement of the base. The same bits at every reading: where MRPT draws its
/// particles anew (Thrun's motion model), the model's own covariance is taken instead of the particles'.
std::optional<ActionMotion> motionOf(const mrpt::obs::CAction::ConstPtr& action);

/// First a, then b.
ActionMotion join(const ActionMotion& a, const ActionMotion& b);

}  // namespace omnimapper::source
