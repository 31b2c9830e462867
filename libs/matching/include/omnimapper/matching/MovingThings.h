#pragma once

#include <mrpt/math/TPose2D.h>
#include <omnimapper/matching/ScanView.h>
#include <omnimapper/matching/ScanWithNormals.h>

#include <Eigen/Core>
#include <cstddef>
#include <deque>
#include <vector>

namespace omnimapper::matching {

/// Tells the things that move from those that stand (thesis 6.2.4: a robot that follows a person maps the room, not the
/// person). A thing moves if it is where earlier beams passed freely, or if it has left its place and beams now pass
/// there. No class of things is needed: people, trolleys, robots and doors that swing are all recognized. A thing that
/// moved once counts as moving while it is in view, because whoever stops to talk will walk on; unless it turns out to
/// be where it was first seen. Of its points, those stand whose places were occupied before it came: a chair that
/// somebody walks past does not walk.
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
  /// A thing at one time, in the frame of the track.
  struct Sighting {
    Eigen::Vector2f centre;
    std::vector<Eigen::Vector2f> points;
    double seconds = 0;
    std::size_t begin = 0;                             // the first of its points in the scan
    Eigen::Vector2f viewer = Eigen::Vector2f::Zero();  // [m] position of the laser
  };
  /// A place of a thing.
  struct Passed {
    Eigen::Vector2f centre;
    double seconds;
  };
  struct Thing {
    Thing(int new_number, const Sighting& first)
        : number(new_number), anchor(first), last(first), first_seen(first.seconds), first_viewer(first.viewer) {}
    int number;
    Sighting anchor, last;
    Eigen::Vector2f velocity = Eigen::Vector2f::Zero();  // [m/s] while it moves
    double first_seen;                                   // [s]
    Eigen::Vector2f first_viewer;                        // [m] position of the laser when it was first seen
    int suspected = 0;                                   // by how many scans in a row
    std::deque<Passed> trail;                            // where it was lately, oldest first
    double last_moved = 0;                                // [s] when most of its points moved
    Passed recognized = {};  // where it stood before it was recognized as moving, and when that was
    bool moves = false, stands = false, has_gone = false, is_doubted = false, is_beside = false; float width=0;
  };
  static std::vector<Sighting> sightings(const mrpt::math::TPose2D& track_from_scan, double seconds,
                                         const ScanWithNormals& scan);
  std::vector<const Thing*> associated(const std::vector<Sighting>& sightings, double seconds) const;
  static void confirm(const ScanView& view, const Sighting& now, Thing& thing);
  bool isBesideMoving(const Sighting& sighting) const;
  bool standsWhereItWasFree(const Sighting& sighting, float margin) const;
  static bool hasLeftItsPlace(const Thing& thing, const Sighting& now, const ScanView& view, float margin);
  void reconsider(const Sighting& now, Thing& thing);
  std::vector<bool> movingPoints(const Thing& thing, const Sighting& now) const;
  void markMerged(const mrpt::math::TPose2D& track_from_scan, double seconds, const ScanWithNormals& scan,
                  const std::vector<const Thing*>& known, std::vector<bool>& moves) const;
  bool isPoseWrong(const mrpt::math::TPose2D& track_from_scan, const ScanWithNormals& scan) const;
  void look(const ScanView& view, double seconds);

  std::vector<Thing> things_;
  struct Look {
    ScanView view;
    double seconds;
  };
  std::deque<Look> looks_;   // some of the last scans, oldest first
  double last_seconds_ = 0;  // of the scan that was added last
  std::vector<bool> moving_;  // for each of its points
  int next_number_ = 0;
};

}  // namespace omnimapper::matching
