#pragma once

#include <mrpt/math/TPose2D.h>
#include <omnimapper/matching/RecentViews.h>
#include <omnimapper/matching/ScanWithNormals.h>
#include <omnimapper/matching/ThingSighting.h>

#include <Eigen/Core>
#include <cstddef>
#include <deque>
#include <vector>

namespace omnimapper::matching {

/// Tells the things that move from those that stand (thesis 6.2.4: a robot that follows a person maps the room, not the
/// person). A thing moves if it is where earlier beams passed freely, or if it has left its place and beams now pass
/// there. No class of things is needed: people, trolleys, robots and doors that swing are all recognized. A thing that
/// moved once counts as moving while it is in view, because whoever stops to talk will walk on; unless it turns out to
/// be where it was first seen, or goes nowhere after it has become larger. Of its points, those stand whose places were
/// occupied before it came: a chair that somebody walks past does not walk.
///
/// Both tests need poses that are right. Where walls, too, seem to stand where beams passed freely, the pose is wrong
/// rather than the walls new, and nothing more is said to move.
class MovingThings {
 public:
  /// Follows the things of a scan at a known pose. `scan.things` are the numbers that numberThings() gave; they are
  /// replaced by numbers that a thing keeps from scan to scan. `sensor`: position of the laser in the scan's frame [m];
  /// `seconds`: time of the scan, which must increase. Returns the numbers of the things that were recognized as moving
  /// by this scan.
  std::vector<int> add(const mrpt::math::TPose2D& track_from_scan, const Eigen::Vector2f& sensor, double seconds,
                       ScanWithNormals& scan);
  /// What is known of the points of a scan that was not yet added.
  struct Expected {
    std::vector<bool> moves;  ///< for each point, whether it belongs to a thing that moves
    /// For each point, how much it counts in a match, [0, 1]. All points of a thing that was found to stand count
    /// together as one point; all of a thing that may move as far less than one, because what it did since the last
    /// scan it will go on doing. Points of walls count 1.
    std::vector<float> weights;
  };
  Expected expected(const mrpt::math::TPose2D& track_from_scan, double seconds, const ScanWithNormals& scan) const;
  /// For each point of the scan that was added last, whether it moves.
  const std::vector<bool>& moving() const { return moving_; }

 private:
  /// A place of a thing.
  struct Passed {
    Eigen::Vector2f centre;
    double seconds;
  };
  struct Thing {
    Thing(int new_number, const ThingSighting& first)
        : number(new_number),
          anchor(first),
          last(first),
          first_seen(first.seconds),
          first_viewer(first.viewer),
          extent(extentOf(first.points)) {}
    Eigen::Vector2f at(double seconds) const;

    int number;
    ThingSighting anchor, last;
    Eigen::Vector2f velocity = Eigen::Vector2f::Zero();  // [m/s] while it moves
    double first_seen;                                   // [s]
    Eigen::Vector2f first_viewer;                        // [m] position of the laser when it was first seen
    float extent;                                        // [m] lately
    std::deque<Passed> trail;                            // where it was lately, oldest first
    int suspected = 0;                                   // by how many scans in a row
    bool moves = false, stands = false;
    // Of a thing that moves: where and when it was doubted last, and whether it has gone elsewhere since.
    Passed doubted = {Eigen::Vector2f::Zero(), 0};
    bool has_gone = false;
    double last_moved = 0;  // [s] when most of its points moved
  };
  std::vector<const Thing*> associated(const std::vector<ThingSighting>& sightings, double seconds) const;
  std::vector<Thing> following(const std::vector<ThingSighting>& seen, const std::vector<const Thing*>& known);
  std::vector<int> recognize(const ScanView& view, const ScanWithNormals& scan,
                             const mrpt::math::TPose2D& track_from_scan, std::vector<Thing>& followed) const;
  bool isBesideMoving(const ThingSighting& sighting) const;
  std::vector<bool> movingPoints(const Thing& thing) const;
  void reconsider(const ScanView& view, Thing& thing);
  void markMerged(const mrpt::math::TPose2D& track_from_scan, double seconds, const ScanWithNormals& scan,
                  const std::vector<const Thing*>& known, std::vector<bool>& moves) const;

  std::vector<Thing> things_;
  RecentViews views_;
  std::vector<bool> moving_;
  double last_seconds_ = 0;  // of the scan that was added last
  int next_number_ = 0;
};

}  // namespace omnimapper::matching
