#pragma once

#include <omnimapper/base/Id.h>
#include <omnimapper/geometry/Se3.h>
#include <omnimapper/map/KeyFrames.h>
#include <omnimapper/map/Landmark.h>
#include <omnimapper/obs/Rgb.h>

#include <Eigen/Core>
#include <optional>
#include <set>
#include <vector>

namespace omnimapper::plugins {

using ObjectPoints = std::vector<Eigen::Vector3f>;  ///< [m]

/// The part of an object that one key frame shows. Frame: the base of that key frame [m], so that the points follow the
/// key frame when a loop is closed.
struct ObjectView {
  base::KeyFrameId frame;
  double distance = 0;                            ///< [m] from the camera to the middle of the points
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();  ///< unit, away from the surface on which the object stands
  std::optional<Eigen::Vector3d> foot;            ///< [m] a point of that surface below the object; none without one
  ObjectPoints points;                            ///< [m]
  std::vector<obs::Rgb> colours;                  ///< one for each point, or none at all
};

/// Bounds of the memory that a model takes.
struct ModelLimits {
  double voxel = 0.005;   ///< [m] points nearer to one another than this are one
  int max_points = 4000;  ///< of all views together
  int max_views = 12;
};

/// The shape of an object, put together from views. Points of different views lie as close together as the estimated
/// poses of their key frames agree.
class ObjectModel {
 public:
  ObjectModel() = default;
  explicit ObjectModel(std::vector<ObjectView> views) : views_(std::move(views)) {}

  const std::vector<ObjectView>& views() const { return views_; }
  std::size_t size() const;
  bool empty() const { return size() == 0; }
  /// Whether some view shows the surface on which the object stands.
  bool standsOnSurface() const;

  /// The model with one more view. Of two points at one place, that of the nearer view stays, because the error of a
  /// depth grows with its square. Beyond the limits, the farthest views are left out and points are thinned evenly.
  ObjectModel with(ObjectView view, const map::KeyFrames& key_frames, const ModelLimits& limits) const;
  /// The views of these key frames alone.
  ObjectModel seenFrom(const std::set<base::KeyFrameId>& frames) const;

  /// The model without the points for which `is_left_out(point in the map)` is true.
  template <class IsLeftOut>
  ObjectModel without(const IsLeftOut& is_left_out, const map::KeyFrames& key_frames) const {
    const ObjectPoints in_map = pointsInMap(key_frames);
    std::vector<bool> keeps;
    for (const auto& point : in_map) keeps.push_back(!is_left_out(point));
    return kept(keeps);
  }

  /// All points in the map [m], view by view.
  ObjectPoints pointsInMap(const map::KeyFrames& key_frames) const;
  /// A colour for each point of pointsInMap(); grey where a view has none.
  std::vector<obs::Rgb> colours() const;
  /// Unit vector in the map: the mean of the views' `up`.
  Eigen::Vector3d upInMap(const map::KeyFrames& key_frames) const;
  /// A point of the surface on which the object stands [m]: that of the nearest view which has one.
  std::optional<Eigen::Vector3d> footInMap(const map::KeyFrames& key_frames) const;
  /// The box around the points with the least base, upright on the surface, which it reaches down to if the points end
  /// less than kLostFoot above it. None without points.
  std::optional<map::Box> box(const map::KeyFrames& key_frames) const;

  static constexpr double kLostFoot = 0.06;  ///< [m]

 private:
  // `keeps`: for each point of pointsInMap().
  ObjectModel kept(const std::vector<bool>& keeps) const;

  std::vector<ObjectView> views_;
};

/// The smallest upright box around points [m]: its z axis is `up`, and the area of its base is the least. Of many
/// points, one in 200 at either end of each axis is left out, because single depths are often wrong at edges. Sizes are
/// at least a millimetre. There must be a point.
map::Box boxAround(const ObjectPoints& points, const Eigen::Vector3d& up);

}  // namespace omnimapper::plugins
