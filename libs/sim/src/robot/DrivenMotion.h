#pragma once

#include <omnimapper/geometry/Se2.h>

#include <vector>

#include "RobotSpace.h"

namespace omnimapper::sim {

/// Limits of the robot's drives.
struct MotionLimits {
  double speed, turn;                      ///< [m/s], [rad/s]
  double acceleration, turn_acceleration;  ///< [m/s^2], [rad/s^2]
};

/// A motion in the plane over time, composed of what a robot with two driven wheels can do. Each part goes from rest to
/// rest.
class DrivenMotion {
 public:
  DrivenMotion(const geometry::Se2& start, const MotionLimits& limits);

  void wait(double seconds);
  /// Turns in place by this angle, of any sign and also more than a full turn [rad].
  void turn(double angle);
  void turnTo(double yaw);
  /// Drives along a polyline that begins where the motion ends. Corners are rounded where the plan leaves room; at
  /// other corners the robot stops and turns in place.
  void follow(const Polyline& corners, const RobotSpace& plan);

  double duration() const { return duration_; }
  const geometry::Se2& end() const { return end_; }
  /// Poses at 0, step, 2 step, ... until the end of the motion or the time `until` is reached [s].
  std::vector<geometry::Se2> sampled(double step, double until) const;

 private:
  /// A point on a path. Between two knots the acceleration along the path is constant.
  struct Knot {
    Eigen::Vector2d position;
    double yaw, curvature;       // [rad], not wrapped; [1/m], to the left
    double travel, speed, time;  // [m], [m/s], [s]
  };
  struct Turn {
    double begin, duration, from, angle;
    Eigen::Vector2d position;
  };
  struct Leg {
    double begin;
    std::vector<Knot> knots;  // empty: the leg is a turn
    Turn turn;
  };

  void drive(std::vector<Knot> knots);
  geometry::Se2 poseIn(const Leg& leg, double time) const;

  MotionLimits limits_;
  geometry::Se2 end_;
  double duration_ = 0;
  std::vector<Leg> legs_;
};

}  // namespace omnimapper::sim
