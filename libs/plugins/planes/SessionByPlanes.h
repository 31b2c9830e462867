#pragma once

#include <omnimapper/plugin/SessionStart.h>
#include <omnimapper/plugin/Verdict.h>
#include <omnimapper/plugin/View.h>

#include <cstddef>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "SurfaceAgreement.h"

namespace omnimapper::plugins {

/// What the newest session has seen lately: pieces of surfaces by key frame, in the frame of the base.
class RecentSurfaces {
 public:
  /// Returns whether there was any plane. `sensor_in_base` [m].
  bool add(const map::KeyFrame& frame, const std::vector<PlaneMeasurement>& measurements,
           const Eigen::Vector3d& sensor_in_base);
  /// Forgets the oldest key frames, so that at most `key_frames` remain.
  void keep(std::size_t key_frames);
  std::size_t size() const { return seen_.size(); }                        ///< number of key frames
  const Eigen::Vector3d& sensorInBase() const { return sensor_in_base_; }  ///< of the newest [m]

  /// The pieces in the frame of the session, by the poses that the key frames have now; of pieces of one place, only
  /// the one seen last. Those of the key frames from the `first` of size() on, up to the one before `end`.
  std::vector<SurfaceSample> inSession(const map::Map& map, std::size_t first, std::size_t end) const;
  std::vector<SurfaceSample> inSession(const map::Map& map) const { return inSession(map, 0, size()); }
  /// The first key frame of the newest view: those before it were seen from 1 m away or in a direction 45 deg away from
  /// the newest. None if there are none.
  std::optional<std::size_t> secondView(const map::Map& map) const;

 private:
  struct Seen {
    base::KeyFrameId frame;
    std::vector<SurfaceSample> in_base;
  };
  std::deque<Seen> seen_;
  Eigen::Vector3d sensor_in_base_ = Eigen::Vector3d::Zero();
};

/// Where surfaces that a session has seen fit the map.
struct SessionPlacing {
  geometry::Se3 map_from_session;
  SurfaceAgreement agreement;
  bool is_distinct = false;  ///< no other place explains nearly as much
};

/// The place in the map that explains most of the samples, found from triples of planes; none if nothing fits.
/// `planar`: the session can be moved only along the floor and turned about z.
std::optional<SessionPlacing> placeOf(const std::vector<SurfaceSample>& in_session, const KnownSurfaces& map,
                                      bool planar);

/// Locates a session whose start is unknown by the planes that it sees. Planes look alike: the place must explain what
/// is seen in two views, hold the session in each direction, and be better by far than every other place.
class SessionByPlanes {
 public:
  /// Takes the planes at a key frame of the newest session. `is_free`: no other plugin searches for the session, and it
  /// is free to move (mapper::whyFixed()). Returns the place of the session when it becomes known.
  std::optional<mapper::SessionPlace> take(const map::KeyFrame& frame, const RecentSurfaces& recent,
                                           const PlaneLandmarkIndex& known, const mapper::View& view, bool planar,
                                           bool is_free);
  /// True if the place of the session is unknown, so that positions do not show which surface of the map is seen.
  bool isLost() const { return is_lost_ || is_unsolved_; }
  /// In words, what the last search found.
  const std::string& found() const { return found_; }

 private:
  bool is_known_whether_lost_ = false, is_lost_ = false;
  bool is_unsolved_ = false;                         // it was placed, but its uncertainty is still that of before
  std::size_t since_placed_ = 0, since_search_ = 0;  // [key frames]
  std::size_t searches_ = 0;                         // without an answer
  std::string found_;
};

/// Watches whether what a session sees agrees with the map, at the place where the estimate has it.
class PlaneWatch {
 public:
  /// To be called when planes were added to `recent`.
  void add(const RecentSurfaces& recent, const PlaneLandmarkIndex& known, const mapper::View& view, bool planar);
  /// To be called after each key frame: what was seen long ago confirms nothing.
  void endKeyFrame() { ++since_confirmed_; }
  bool isContradicted() const { return contradicting_ >= kInTurn; }
  bool isConfirmed() const { return since_confirmed_ <= kRecent && !isContradicted(); }
  /// Whether the views of the session contradicted the map; none if nothing was compared.
  std::optional<mapper::Evidence> evidence() const;

 private:
  static constexpr std::size_t kInTurn = 2, kRecent = 40;  // [comparisons] [key frames]
  std::size_t calls_ = 0, compared_ = 0, contradicted_ = 0, contradicting_ = 0;
  std::size_t since_confirmed_ = kRecent + 1;
};

}  // namespace omnimapper::plugins
