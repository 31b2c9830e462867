#pragma once

#include <omnimapper/sim_world/Track.h>

#include <Eigen/Core>
#include <vector>

namespace omnimapper::sim {

/// The drive of a robot as a line on the floor, by distance travelled. Turning in place adds no distance.
class RobotPath {
 public:
  explicit RobotPath(const Track& map_from_base);

  /// Distance travelled at the end of the drive [m].
  double length() const { return knots_.back().travel; }
  /// Time of the end of the drive [s].
  double end() const { return map_from_base_.places().back().time; }
  /// Distance travelled until a time [m].
  double travelAt(double time) const;
  Eigen::Vector2d robotAt(double time) const;
  /// The point of the line after a distance travelled. Before its beginning and beyond its end, the line goes on
  /// straight in the robot's heading there.
  Eigen::Vector2d pointAt(double travel) const;
  /// Unit vector of the mean direction of the line from 0.4 m before to 0.4 m beyond a point.
  Eigen::Vector2d directionAt(double travel) const;
  /// Distances travelled at which the line comes nearest to a point, once for each time that it comes within `reach`
  /// of the point [m].
  std::vector<double> passings(const Eigen::Vector2d& point, double reach) const;

 private:
  struct Knot {
    double time, travel;  // [s], [m]
    Eigen::Vector2d in_map;
  };
  Track map_from_base_;
  std::vector<Knot> knots_;                       // at least kSpacing apart, but for the last
  Eigen::Vector2d first_heading_, last_heading_;  // unit
};

}  // namespace omnimapper::sim
