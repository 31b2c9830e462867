#pragma once

#include <omnimapper/sim_world/People.h>

#include <vector>

namespace omnimapper::sim {

/// Where a walker's body and feet are at a time.
struct Stance {
  bool walks = false;
  Eigen::Vector2d body;  // in the map [m]
  double heading = 0;    // of the path [rad]; while standing that of the last walk, before all walks that of the first
  struct Foot {
    Eigen::Vector2d in_map;  // [m]
    double yaw = 0;          // [rad]
    double lift = 0;         // above the floor [m]
  };
  Foot left, right;  // only while it walks
};

/// The walks of a person: stretches of walking between times of standing.
class Walk {
 public:
  /// `half_hips` is the distance of the feet to either side of the path, `step` about that between footprints [m].
  Walk(const std::vector<PersonSpec::Waypoint>& waypoints, double half_hips, double step);
  Stance at(double time) const;
  /// Whether it stands all the time from begin to end [s].
  bool stands(double begin, double end) const;
  /// The heading of the first walk that begins after `time`, if it does so within `ahead` seconds; else null.
  const double* headingSoon(double time, double ahead) const;
  bool everWalks() const { return !runs_.empty(); }

 private:
  struct Run {
    std::vector<PersonSpec::Waypoint> waypoints;  // consecutive, each at another place than the one before
    std::vector<double> along;                    // distance travelled to each [m]
    int steps = 1;
    double first_heading = 0;
    double begin() const { return waypoints.front().time; }
    double end() const { return waypoints.back().time; }
    double length() const { return along.back(); }
    double travelAt(double time) const;
    Eigen::Vector2d placeAt(double travel) const;
    double headingAt(double travel) const;
  };
  Stance::Foot printOf(const Run& run, double travel, bool right) const;
  Stance::Foot footAt(const Run& run, double travel, bool right) const;

  std::vector<Run> runs_;
  std::vector<PersonSpec::Waypoint> waypoints_;
  double half_hips_;
};

}  // namespace omnimapper::sim
