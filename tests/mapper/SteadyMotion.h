#pragma once

#include <omnimapper/plugin/PosePlugin.h>

// A robot that goes 1 m a second along x, told by nobody's odometry.
namespace omnimapper::testing {

inline base::Stamp at(double seconds) {
  return base::stampFromUnix(1'000'000'000) + base::durationFromSeconds(seconds);
}

class Steady : public mapper::PosePlugin {
 public:
  Taken add(const mrpt::obs::CObservation::ConstPtr&) override { return Taken::not_mine; }
  std::optional<mapper::RelativeMotion> between(base::Stamp begin, base::Stamp end) const override {
    const double way = base::secondsBetween(begin, end);
    return mapper::RelativeMotion{mrpt::poses::CPose3D(way, 0, 0, 0, 0, 0),
                                  0.01 * way * Eigen::Matrix<double, 6, 6>::Identity()};
  }
  std::optional<base::Stamp> coveredUntil() const override { return std::nullopt; }
};

}  // namespace omnimapper::testing
