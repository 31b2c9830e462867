#pragma once

#include <omnimapper/matching/ScanTracker.h>

#include <Eigen/Core>

namespace omnimapper::matching {

/// Covariance of a match by what stands, x y yaw in the scan's frame [m] [rad].
Eigen::Matrix3d covarianceOf(const ScanMatch& match);

/// Whether a covariance is below ScanTracker::kDetermined and kDeterminedYaw in all directions.
bool isDetermined(const Eigen::Matrix3d& covariance);

/// Replaces the pose of a match by its mean with a measured motion, and sets the difference that is left. Where the
/// match is better than 6 mm it is taken as it is, because wheels have systematic errors, too. The more the two
/// contradict each other, the less the measured motion counts: wheels slip. Where they differ by more than 0.1 m or
/// 5 deg, `search_covariance` covers both.
void combine(const MeasuredMotion& measured, ScanTracker::Tracked& tracked);

}  // namespace omnimapper::matching
