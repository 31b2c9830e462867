#include "Carrier.h"

#include <omnimapper/sim_world/Random.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "Ground.h"

namespace omnimapper::sim {

namespace {

constexpr std::uint64_t kHandStream = 0x4A2D;

/// Height of the base, pitch (nose down positive) and roll (left side up positive), applied in the order yaw, pitch,
/// roll.
using Attitude = std::array<double, 3>;

// Replaces each value by the mean over a window around it, which is shorter at the ends.
void smooth(std::vector<Attitude>& values, int half_width) {
  std::vector<Attitude> sums(values.size() + 1, Attitude{});
  for (std::size_t i = 0; i < values.size(); ++i) {
    // Sums are of differences to the first value, so that they stay exactly zero where nothing changes.
    for (int a = 0; a < 3; ++a) sums[i + 1][a] = sums[i][a] + (values[i][a] - values[0][a]);
  }
  const Attitude origin = values[0];
  const int count = static_cast<int>(values.size());
  for (int i = 0; i < count; ++i) {
    const int half = std::min({half_width, i, count - 1 - i});
    for (int a = 0; a < 3; ++a) values[i][a] = origin[a] + (sums[i + half + 1][a] - sums[i - half][a]) / (2 * half + 1);
  }
}

/// A sum of sines with frequencies in a band, which mostly stays within its amplitude.
class Wander {
 public:
  Wander(double amplitude, double low, double high, Random& random) {
    for (Sine& sine : sines_) {
      sine = {amplitude / std::sqrt(static_cast<double>(sines_.size())), 2 * M_PI * random.uniform(low, high),
              random.uniform(0, 2 * M_PI)};
    }
  }
  double at(double time) const {
    double sum = 0;
    for (const Sine& sine : sines_) sum += sine.amplitude * std::sin(sine.pulse * time + sine.phase);
    return sum;
  }

 private:
  struct Sine {
    double amplitude, pulse, phase;
  };
  std::array<Sine, 5> sines_;
};

}  // namespace

std::vector<geometry::Se3> poseOnGround(const std::vector<geometry::Se2>& motion, const World& world, double radius) {
  constexpr int kSmoothing = kDriveRate / 10;  // half of the window; three passes make a bell curve of 0.2 s
  const Ground ground(world);
  std::vector<Attitude> attitudes;
  for (std::size_t i = 0; i < motion.size(); ++i) {
    const geometry::Se2& pose = motion[i];
    if (i > 0 && pose.x == motion[i - 1].x && pose.y == motion[i - 1].y && pose.yaw == motion[i - 1].yaw) {
      attitudes.push_back(attitudes.back());
      continue;
    }
    const auto height = [&](double x, double y) { return ground.heightAt(pose * Eigen::Vector2d(x, y)); };
    const double front = height(radius, 0), back = height(-radius, 0), left = height(0, radius),
                 right = height(0, -radius);
    attitudes.push_back({0.25 * (front + back + left + right), -std::atan2(front - back, 2 * radius),
                         std::atan2(left - right, 2 * radius)});
  }
  for (int pass = 0; pass < 3; ++pass) smooth(attitudes, kSmoothing);
  std::vector<geometry::Se3> poses;
  for (std::size_t i = 0; i < motion.size(); ++i) {
    const auto& [z, pitch, roll] = attitudes[i];
    geometry::Se3 pose = geometry::lift(motion[i]);
    pose.translation.z() = z;
    pose.rotation = (pose.rotation * Eigen::AngleAxisd(pitch, Eigen::Vector3d::UnitY()) *
                     Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitX()))
                        .normalized();
    poses.push_back(pose);
  }
  return poses;
}

void carryByHand(std::vector<geometry::Se3>& poses, const DriveOptions& options, std::uint64_t seed) {
  Random random(seed, {kHandStream});
  // A step takes about half a second. The body goes up and down with each, left and right with every second one.
  const auto sway = [&](double factor, double low, double high) {
    return Wander(factor * options.sway, low, high, random);
  };
  const std::array<Wander, 3> place{sway(0.6, 0.2, 1.0), sway(1.0, 0.6, 1.1), sway(0.7, 1.6, 2.2)};
  const Wander gaze(options.gaze, 0.03, 0.25, random), nod(0.5 * options.gaze, 0.03, 0.2, random);
  const auto turning = [&] { return Wander(options.sway_turn, 0.3, 1.2, random); };
  const std::array<Wander, 3> turn{turning(), turning(), turning()};
  const auto trembling = [&](double amplitude) { return Wander(amplitude, 4, 9, random); };
  const std::array<Wander, 3> shake{trembling(options.shake), trembling(options.shake), trembling(options.shake)};
  const std::array<Wander, 3> shake_turn{trembling(options.shake_turn), trembling(options.shake_turn),
                                         trembling(options.shake_turn)};
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const double time = static_cast<double>(i) / kDriveRate;
    geometry::Vector6d delta;
    for (int axis = 0; axis < 3; ++axis) {
      delta[axis] = place[axis].at(time) + shake[axis].at(time);
      delta[3 + axis] = turn[axis].at(time) + shake_turn[axis].at(time);
    }
    delta[2] += options.eye_height;
    delta[4] += nod.at(time);
    delta[5] += gaze.at(time);
    poses[i] = geometry::plus(poses[i], delta);
  }
}

}  // namespace omnimapper::sim
