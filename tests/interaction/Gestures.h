#pragma once

#include <omnimapper/interaction/PointingTarget.h>

#include <random>
#include <vector>

namespace omnimapper::interaction {

/// A gesture whose rays miss this target by these errors (theta as of a right arm).
inline PointingGesture gestureWith(const Eigen::Vector3d& target, const PointingError& elbow_hand,
                                   const PointingError& head_hand, bool is_right_arm = true,
                                   const Eigen::Vector3d& hand = {0, 0, 1.1}) {
  PointingGesture gesture;
  gesture.is_right_arm = is_right_arm;
  gesture.hand = hand;
  gesture.sensor = {2, 0, 1.2};
  const auto from = [&](PointingError error, double length) -> Eigen::Vector3d {
    if (!is_right_arm) error.theta = -error.theta;
    return hand - length * directionWithError(hand, target, error);
  };
  gesture.elbow = from(elbow_hand, 0.3);
  gesture.head = from(head_hand, 0.6);
  return gesture;
}

/// Draws the errors of people. A user has a bias beside the table's mean and another spread than the table's, both as
/// parts of its standard deviation; without them all users are alike and as the table.
class DrawnErrors {
 public:
  DrawnErrors(const PointingRow& row, unsigned seed) : row_(row), random_(seed) {}
  void nextUser(double bias_sigma, double least_spread, double most_spread) {
    for (double& bias : bias_) bias = bias_sigma * gaussian();
    for (double& spread : spread_) spread = uniform(least_spread, most_spread);
  }
  PointingError elbowHand() { return {draw(row_.elbow_hand.theta, 0), draw(row_.elbow_hand.psi, 1)}; }
  PointingError headHand() { return {draw(row_.head_hand.theta, 2), draw(row_.head_hand.psi, 3)}; }
  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
  double gaussian() { return std::normal_distribution<double>()(random_); }

 private:
  double draw(const AngleError& error, int i) {
    return error.mean + error.sigma * (bias_[i] + spread_[i] * gaussian());
  }
  PointingRow row_;
  std::mt19937_64 random_;
  double bias_[4] = {0, 0, 0, 0}, spread_[4] = {1, 1, 1, 1};
};

/// The surface of a can [m] that stands upright, by points on its side.
inline std::vector<Eigen::Vector3d> canAt(const Eigen::Vector3d& middle, double radius = 0.033, double height = 0.12) {
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < 8; ++i)
    for (int j = -2; j <= 2; ++j)
      points.push_back(
          middle + Eigen::Vector3d(radius * std::cos(i * M_PI / 4), radius * std::sin(i * M_PI / 4), j * height / 4));
  return points;
}

}  // namespace omnimapper::interaction
