#pragma once

#include <omnimapper/plugin/PosePlugin.h>

// A pose source for a robot that moves at 1 m/s along x, without odometry.
namespace omnimapper::testing {

inline base::Stamp at(double seconds) {
  return base::stampFromUnix(1'000'000'000) + base::durationFromSeconds(seconds);
}

class Steady : public mapper::PosePlugin {
 public:
  Taken add(const mrpt::obs::CObservation::ConstPtr&) override { return Taken::not_mine; }
  std::optional<mapper::RelativeMotion> between(base::Stamp begin, base::Stamp end) const override {
    const double distance = base::secondsBetween(begin, end);
    return mapper::RelativeMotion{mrpt::poses::CPose3D(distance, 0, 0, 0, 0, 0),
                                  0.01 * distance * Eigen::Matrix<double, 6, 6>::Identity()};
  }
  std::optional<base::Stamp> coveredUntil() const override { return std::nullopt; }
};

}  // namespace omnimapper::testing
