#pragma once

#include <mrpt/obs/CObservationRobotPose.h>
#include <omnimapper/check/LogFacts.h>

namespace omnimapper::check {

/// Statistics on the absolute poses of one label. Those that are not finite are left out.
class PoseStatistics {
 public:
  void add(const mrpt::obs::CObservationRobotPose& observation);
  PoseFacts facts() const;

 private:
  std::size_t poses_ = 0;
  double up_ = 0;  // z of the base's z axis in the poses' frame, summed
};

}  // namespace omnimapper::check
