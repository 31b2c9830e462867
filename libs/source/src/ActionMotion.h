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
  std::uint64_t actions = 1;                                   ///< number of actions joined in it
};

/// The motion of an action; none for null and for an action that is no movement of the base. Every reading gives the
/// same bits: for Thrun's motion model, whose particles MRPT samples anew each time, the covariance is computed from
/// the model instead of from the particles.
std::optional<ActionMotion> motionOf(const mrpt::obs::CAction::ConstPtr& action);

/// Motion a followed by motion b.
ActionMotion join(const ActionMotion& a, const ActionMotion& b);

}  // namespace omnimapper::source
