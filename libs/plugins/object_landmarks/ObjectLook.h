#pragma once

#include <omnimapper/camera/DepthImage.h>
#include <omnimapper/geometry/Se3.h>

#include "KnownObject.h"

namespace omnimapper::plugins {

/// A depth image in which objects are looked for.
struct LookingCamera {
  const camera::DepthImage& image;
  geometry::Se3 optical_from_map;  ///< x right, y down, z forward
  double min_depth = 0.4;          ///< [m] nearer points are not measured
  double farthest_depth = 50;      ///< [m] larger depths are none that a camera measures, as those in a wrong unit
  double max_depth = 3.5;          ///< [m] farther objects are not looked for
};

/// How the points of an object agree with a depth image: those that face the camera and whose absence the image would
/// show.
struct LookCounts {
  int seen = 0;        ///< the depth is that of the point
  int hidden = 0;      ///< something nearer is before it
  int through = 0;     ///< the depths there are greater than noise and pose explain
  int unmeasured = 0;  ///< the image has no depth there
  int undecided = 0;   ///< without the object, the depth would hardly be another one: just above the surface
  int outside = 0;     ///< beside the image, or beyond its range

  Sight sight() const;
};

/// Whether the middle of the object's box is in the view and the range of the camera.
bool isInView(const ObjectGeometry& object, const LookingCamera& camera);

/// Looks for an object in a depth image. A point counts as seen through only if all depths within two pixels of it are
/// greater than its own by more than three standard deviations of the depth (camera::DepthNoise) and a centimetre. The
/// surface on which the object stands tells what depth the image would have without the object.
LookCounts lookFor(const ObjectGeometry& object, const LookingCamera& camera);

/// Whether an object that seems to be absent may be in the image after all, because its place relative to the camera is
/// not known well: moved to some place within an ellipsoid, at least half of its points that face the camera, and
/// whose absence the image would show, agree with the depths. `reach`: the half axes of the ellipsoid in the optical
/// frame, one in each column [m]; they are orthogonal.
bool mayBeBeside(const ObjectGeometry& object, const LookingCamera& camera, const Eigen::Matrix3d& reach);

}  // namespace omnimapper::plugins
