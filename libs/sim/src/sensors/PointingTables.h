#pragma once

namespace omnimapper::sim {

enum class SkeletonSoftware { ms_sdk, openni };

/// Mean and standard deviation of both angles of PointingError [deg].
struct PointingStatistics {
  double theta_mean, theta_sigma, psi_mean, psi_sigma;
};

/// Both rays of one tracker for one target.
struct PointingRow {
  PointingStatistics elbow_hand, head_hand;
};

/// Tables 12 and 13 of the thesis: targets 1 to 7, right arms of six users two metres from the sensor. Target 0 is the
/// column of all targets, whose values follow from the others. Three standard deviations of target 7 are printed with
/// a minus sign there.
const PointingRow& pointingRow(SkeletonSoftware software, int target);

}  // namespace omnimapper::sim
