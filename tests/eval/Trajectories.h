#pragma once

#include <omnimapper/eval/Trajectory.h>

#include <random>

namespace omnimapper::eval {

inline base::Stamp at(double seconds) {
  return base::stampFromUnix(1'000'000'000 + seconds);
}

inline StampedPose planar(double seconds, double x, double y, double yaw = 0) {
  return {at(seconds), geometry::lift({x, y, yaw})};
}

/// A walk in space of `count` poses, one a second: steps of about a metre, turns of about 0.3 rad.
inline Trajectory randomWalk(int count, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  Trajectory walk;
  geometry::Se3 pose;
  for (int i = 0; i < count; ++i) {
    walk.push_back({at(i), pose});
    geometry::Vector6d step;
    for (int k = 0; k < 6; ++k) step[k] = (k < 3 ? 1.0 : 0.3) * normal(random);
    pose = plus(pose, step);
  }
  return walk;
}

/// The walk with noise of `sigma` [m] and a tenth of it [rad] on every pose.
inline Trajectory withNoise(Trajectory walk, double sigma, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  for (auto& [stamp, pose] : walk) {
    geometry::Vector6d error;
    for (int k = 0; k < 6; ++k) error[k] = (k < 3 ? 1.0 : 0.1) * sigma * normal(random);
    pose = plus(pose, error);
  }
  return walk;
}

/// The trajectory in another world: other_from_body = other_from_world * world_from_body.
inline Trajectory inOtherWorld(const geometry::Se3& other_from_world, Trajectory trajectory) {
  for (auto& [stamp, pose] : trajectory) pose = other_from_world * pose;
  return trajectory;
}

inline geometry::Se3 someMotion() {
  return {geometry::expSo3({0.4, -1.1, 2.0}), {12, -3, 0.5}};
}

}  // namespace omnimapper::eval
