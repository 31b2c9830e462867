#pragma once

#include <omnimapper/geometry/Plane3.h>
#include <omnimapper/geometry/Se3.h>
#include <omnimapper/map/KeyFrames.h>
#include <omnimapper/surfaces/CellGrid.h>

#include <Eigen/Core>
#include <cstdint>
#include <deque>
#include <vector>

#include "PlaneLandmarkIndex.h"
#include "PlaneMeasurement.h"

namespace omnimapper::plugins {

/// A small piece of a measured surface.
struct SurfaceSample {
  Eigen::Vector3d point;   ///< [m]
  Eigen::Vector3d normal;  ///< unit, to the free side
  Eigen::Vector3d sensor;  ///< where it was seen from [m]
  double area = 0;         ///< of the piece [m^2]
};

/// The measured planes in pieces of a quarter of a metre, in the frame of the base. Lines of lasers have no area and
/// give none. `sensor_in_base` [m].
std::vector<SurfaceSample> samplesOf(const std::vector<PlaneMeasurement>& measurements,
                                     const Eigen::Vector3d& sensor_in_base);
/// The sample in frame a.
SurfaceSample operator*(const geometry::Se3& a_from_b, const SurfaceSample& sample_in_b);

/// How measured surfaces agree with those of a map [m^2].
struct SurfaceAgreement {
  double agrees = 0;  ///< area that lies on a surface of the map
  /// Area that was seen through a surface of the map, and area of the map that was seen through what is seen now.
  double contradicts = 0;
  double all = 0;  ///< area of all samples; where they neither agree nor contradict, the map has nothing
  /// Sum of area * normal * normal^T over the area that agrees: how well it holds the place in each direction.
  Eigen::Matrix3d held = Eigen::Matrix3d::Zero();

  /// Area that holds the place in the direction in which it is held worst [m^2]; `planar`: the height is given.
  double heldAtLeast(bool planar) const;
  /// Of the area about which the map says something, the share that agrees; 0 if there is none.
  double share() const { return agrees + contradicts > 0 ? agrees / (agrees + contradicts) : 0; }
};

/// The surfaces of earlier sessions in a map, for comparison with what the newest session sees. Refers to the index
/// that it was made of, and is valid until that changes.
class KnownSurfaces {
 public:
  /// Candidates, which may be noise, are left out, and so is all that `session` has seen.
  /// `sensor_in_base`: where the sensor was on the base when the map was made [m]; it is taken for that of now.
  KnownSurfaces(const PlaneLandmarkIndex& known, std::uint16_t session, const map::KeyFrames& key_frames,
                const Eigen::Vector3d& sensor_in_base);

  /// A surface, as far as earlier sessions have seen it.
  struct Part {
    geometry::Plane3 plane;
    const surfaces::CellGrid* seen;
    double area;  ///< [m^2]

    /// Whether it was seen at the foot of a point, or within 0.1 m of it.
    bool wasSeenNear(const Eigen::Vector3d& point_in_map) const;
  };
  const std::vector<Part>& all() const { return parts_; }
  /// The surface that a sample lies on; null if there is none.
  const Part* under(const SurfaceSample& sample_in_map) const;
  SurfaceAgreement compare(const std::vector<SurfaceSample>& samples, const geometry::Se3& map_from_samples) const;
  /// The pose near `map_from_samples` at which the samples that lie on surfaces of the map lie on them best. `planar`:
  /// only x, y and the heading change.
  geometry::Se3 settled(const std::vector<SurfaceSample>& samples, geometry::Se3 map_from_samples, bool planar) const;

 private:
  std::vector<Part> parts_;
  std::deque<surfaces::CellGrid> grids_;  // of surfaces that the session has seen, too
  std::vector<SurfaceSample> samples_;    // of the surfaces, as they were seen when the map was made
};

/// A plane that a session has seen, by its samples.
struct SeenPlane {
  Eigen::Vector3d normal = Eigen::Vector3d::Zero(), middle = Eigen::Vector3d::Zero();
  double area = 0;  ///< [m^2]
  std::vector<Eigen::Vector3d> points;
};
/// The planes of samples, the largest first.
std::vector<SeenPlane> seenPlanesOf(const std::vector<SurfaceSample>& samples);

}  // namespace omnimapper::plugins
