#pragma once

#include <omnimapper/base/OptionTable.h>
#include <omnimapper/base/Stamp.h>
#include <omnimapper/geometry/Se3.h>
#include <omnimapper/interaction/TrackedBody.h>

#include <deque>
#include <optional>
#include <vector>

namespace omnimapper::interaction {

/// When an arm points (thesis 6.1.2.2, 6.2.3).
struct GestureOptions {
  double min_angle = 0.78539816339744831;  ///< [rad] of the forearm from the vertical downwards
  double still_time = 0.5;                 ///< [s] for which elbow and hand stay where they are
  double still_radius = 0.08;              ///< [m] from their mean, within which they stay
  static const base::OptionTable<GestureOptions>& table();
};

/// An arm that is held still and is not hanging. The joints are means over the last still_time, in a frame with z up.
struct PointingGesture {
  base::Stamp begin, end;  ///< first and last skeleton of the mean
  bool is_right_arm = true;
  Eigen::Vector3d hand = Eigen::Vector3d::Zero();
  std::optional<Eigen::Vector3d> elbow, head;  ///< at least one
  Eigen::Vector3d sensor = Eigen::Vector3d::Zero();
  int frames = 0;
  int hold = 0;  ///< number of this holding still of that arm: the next one has another
};

/// The gesture in another frame.
PointingGesture transformed(const geometry::Se3& there_from_here, PointingGesture gesture);

/// Watches one person for pointing gestures.
class GestureWatch {
 public:
  explicit GestureWatch(const GestureOptions& options) : options_(options) {}

  /// Takes the next skeleton, in a frame with z up that does not move. Stamps that are not later than the last, or
  /// more than 1 s later, begin anew. Returns each arm that has been pointing for still_time: at most both.
  std::vector<PointingGesture> add(base::Stamp stamp, const TrackedBody& body);

  base::Stamp last() const { return last_; }

 private:
  struct Sample {
    base::Stamp stamp;
    Eigen::Vector3d hand, sensor;
    std::optional<Eigen::Vector3d> elbow, head;
  };
  struct Arm {
    std::deque<Sample> samples;
    int hold = 0;
    bool is_holding = false;
  };
  std::optional<PointingGesture> watch(Arm& arm, bool is_right, base::Stamp stamp, const TrackedBody& body) const;
  std::optional<PointingGesture> meanOf(const Arm& arm) const;

  GestureOptions options_;
  Arm left_, right_;
  base::Stamp last_;
};

}  // namespace omnimapper::interaction
