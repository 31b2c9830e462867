#pragma once

#include <mrpt/obs/CObservationRobotPose.h>
#include <omnimapper/check/LogFacts.h>
#include <omnimapper/motion/Gravity.h>

#include <map>
#include <string>
#include <vector>

#include "SampledImages.h"

namespace omnimapper::check {

/// Determines which way is up, from inertial sensors and from the planes in some of the depth images: in the frame of
/// given poses, or, for a robot on wheels, in its base.
class LevelStatistics {
 public:
  void add(const mrpt::obs::CObservation& observation);
  /// `has_wheels`: the robot has wheel odometry, so its base should be level and is judged too.
  std::vector<LevelFacts> facts(bool has_wheels, const std::vector<SampledImage>& images) const;

 private:
  struct Pose {
    base::Stamp stamp;
    mrpt::poses::CPose3D reference_from_base;
  };
  const Pose* poseAt(const std::vector<Pose>& poses, base::Stamp stamp) const;
  LevelFacts byImu(const std::string& label, const motion::SteadySpans& spans, const std::vector<Pose>* poses) const;
  LevelFacts byPlanes(const std::vector<SampledImage>& images, const std::vector<Pose>* poses) const;

  std::map<std::string, motion::SteadySpans> imus_;  // by label
  std::map<std::string, std::vector<Pose>> poses_;   // by label
};

}  // namespace omnimapper::check
