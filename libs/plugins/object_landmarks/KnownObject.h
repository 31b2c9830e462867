#pragma once

#include <omnimapper/landmarks/LandmarkIndex.h>
#include <omnimapper/map/KeyFrames.h>

#include <Eigen/Geometry>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "ObjectPayload.h"
#include "PointGrid.h"

namespace omnimapper::plugins {

/// Where an object is by the estimated poses of the key frames that saw it. Frame: the map [m].
struct ObjectGeometry {
  ObjectGeometry(const ObjectModel& model, const map::KeyFrames& key_frames);

  static constexpr double kNear = 0.03;  ///< [m] side of the cubes of `grid`

  ObjectPoints points;
  PointGrid grid{kNear};
  Eigen::AlignedBox3f bounds;  ///< along the axes of the map
  map::Box box;
  Eigen::Vector3d up;                   ///< unit, away from the surface on which it stands
  std::optional<Eigen::Vector3d> foot;  ///< a point of that surface
  base::KeyFrameId anchor;              ///< the key frame of the nearest view
};

/// The model's view of the least distance. The model must have one.
const ObjectView& nearestView(const ObjectModel& model);

/// What the plugin keeps of an object beside map and graph.
struct KnownObject : landmarks::KnownLandmark {
  std::shared_ptr<const ObjectPayload> payload;
  /// What images that made no key frame said of it since `payload` was written into the map.
  std::vector<std::pair<Sight, base::Stamp>> looks;

  void refresh(const map::Landmark& landmark, const mapper::View& view);
  /// The evidence of the payload with that of `looks`.
  ObjectEvidence evidence() const;
  /// Computed when it is first asked for after the poses or the model changed.
  const ObjectGeometry& geometry(const map::KeyFrames& key_frames) const;

 private:
  std::vector<geometry::Se3> poses_;  // of the views' key frames, for which geometry_ is valid
  mutable std::shared_ptr<const ObjectGeometry> geometry_;
};

using ObjectIndex = landmarks::LandmarkIndex<KnownObject>;

}  // namespace omnimapper::plugins
