#pragma once

#include <omnimapper/interaction/PointingTarget.h>

#include <Eigen/Geometry>
#include <optional>
#include <vector>

namespace omnimapper::interaction {

/// What is seen from one point, the hand: which surfaces and objects are in the way.
class Sight {
 public:
  Sight(const Eigen::Vector3d& eye, const std::vector<PointedCandidate>& candidates);

  bool hasSurfaces() const { return !surfaces_.empty(); }
  /// The surface that is met first in this direction, or if there is none, the first that goes on there unseen; none if
  /// an object is before it. `direction` is unit.
  std::optional<std::size_t> surfaceAt(const Eigen::Vector3d& direction) const;
  /// Whether another candidate than `own` hides this point.
  bool isHidden(const Eigen::Vector3d& point, std::size_t own) const;
  /// The solid angle [sr] of a surface as far as it reaches, as if nothing hid it.
  double solidAngle(std::size_t surface) const;
  /// That of what is seen of it; at least 0.001 sr.
  double seenAngle(std::size_t surface) const;
  /// Whether anything of a candidate is seen: its middle, a point of it, or one of 1000 directions.
  bool isSeen(std::size_t candidate) const;
  /// Distance [m] of the nearest point of a candidate.
  double rangeOf(std::size_t candidate) const;

 private:
  struct Surface {
    std::size_t candidate;
    const geometry::Polygon3* outline;
    Eigen::Vector3d normal, centre;  // normal is unit
    double radius;                   // of a sphere about the centre
  };
  // An object is seen as the convex hull of its points, projected on the plane at right angles to its middle.
  struct Object {
    std::size_t candidate;
    Eigen::Vector3d ahead, right, up;
    std::vector<Eigen::Vector2d> hull;
    double distance;  // of its middle
  };
  struct Met {
    std::size_t candidate;
    double distance;
  };
  void lookAround();
  std::optional<Met> firstOf(const std::vector<Surface>& surfaces, const Eigen::Vector3d& direction) const;
  std::optional<double> distanceTo(const Surface& surface, const Eigen::Vector3d& direction) const;
  static bool covers(const Object& object, const Eigen::Vector3d& direction);

  Eigen::Vector3d eye_;
  const std::vector<PointedCandidate>& candidates_;
  std::vector<Surface> surfaces_, unseen_;  // unseen_: as far as they reach
  std::vector<int> hits_;                   // of 1000 even directions, by candidate
  std::vector<Object> objects_;
};

}  // namespace omnimapper::interaction
