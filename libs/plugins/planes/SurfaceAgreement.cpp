#include "SurfaceAgreement.h"

#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/geometry/SymmetricEigen.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <utility>

#include "PlaneExtent.h"

namespace omnimapper::plugins {

using Eigen::Vector3d;
using geometry::Se3;
using Part = KnownSurfaces::Part;

namespace {

constexpr double kOnSurface = 0.1;  // [m] from a surface to a sample that lies on it
constexpr double kParallel = 0.94;  // cosine of 20 deg: normals of one surface

bool wasSeenAt(const surfaces::CellGrid& seen, const Vector3d& point) {
  const auto cell = seen.cellAt(point);
  return cell && seen.isSet(*cell);
}

// Of the four points at `distance` [m] from a point along the axes of the grid, the number of those that were seen.
int countAround(const surfaces::CellGrid& seen, const Vector3d& point, double distance) {
  const Vector3d u = distance * seen.u(), v = distance * seen.v();
  return wasSeenAt(seen, point + u) + wasSeenAt(seen, point - u) + wasSeenAt(seen, point + v) +
         wasSeenAt(seen, point - v);
}

// At an edge, a ray may pass beside the real surface.
bool wasSeenAround(const surfaces::CellGrid& seen, const Vector3d& point) {
  const double edge = std::max(0.15, seen.cell());  // [m]
  return wasSeenAt(seen, point) && countAround(seen, point, edge) == 4;
}

// Whether the ray from the sensor to the sample passes through the part of the plane that was seen.
bool isSeenThrough(const geometry::Plane3& plane, const surfaces::CellGrid& seen, const SurfaceSample& sample) {
  constexpr double kThick = 0.25, kSensor = 0.05;  // [m]
  const double before = signedDistance(plane, sample.sensor), behind = signedDistance(plane, sample.point);
  if (before * behind >= 0 || std::abs(before) < kSensor || std::abs(behind) < kThick) return false;
  return wasSeenAround(seen, sample.sensor + before / (before - behind) * (sample.point - sample.sensor));
}

}  // namespace

std::vector<SurfaceSample> samplesOf(const std::vector<PlaneMeasurement>& measurements, const Vector3d& sensor) {
  constexpr double kPiece = 0.25;  // [m]
  std::vector<SurfaceSample> samples;
  for (const auto& measurement : measurements) {
    if (measurement.is_line || !measurement.why_useless.empty()) continue;
    const auto& outline = measurement.outline_in_base;
    if (!(extentOf(outline) < kLargestCounted)) continue;
    auto pieces = surfaces::CellGrid::around(measurement.plane_in_base, outline, kPiece);
    pieces.fill(outline, measurement.holes_in_base);
    for (int row = 0; row < pieces.rows(); ++row)
      for (int column = 0; column < pieces.columns(); ++column)
        if (pieces.isSet({column, row}))
          samples.push_back(
              {pieces.middleOf({column, row}), measurement.plane_in_base.normal, sensor, pieces.areaOfCell()});
  }
  return samples;
}

SurfaceSample operator*(const Se3& a_from_b, const SurfaceSample& sample) {
  return {a_from_b * sample.point, a_from_b.rotation * sample.normal, a_from_b * sample.sensor, sample.area};
}

double SurfaceAgreement::heldAtLeast(bool planar) const {
  if (planar) return geometry::eigenvaluesOf<2>(held.topLeftCorner<2, 2>())[0];
  return geometry::eigenvaluesOf<3>(held)[0];
}

bool Part::wasSeenNear(const Vector3d& point) const {
  constexpr double kNear = 0.1;  // [m]
  return wasSeenAt(*seen, point) || countAround(*seen, point, kNear) > 0;
}

std::vector<SeenPlane> seenPlanesOf(const std::vector<SurfaceSample>& samples) {
  constexpr double kAlong = 0.99, kOff = 0.1;  // cosine of 8 deg, [m]
  std::vector<SeenPlane> planes;
  for (const auto& sample : samples) {
    const auto same = std::find_if(planes.begin(), planes.end(), [&](const SeenPlane& plane) {
      return plane.normal.normalized().dot(sample.normal) > kAlong &&
             std::abs(plane.normal.normalized().dot(sample.point - plane.middle)) < kOff;
    });
    SeenPlane& plane = same == planes.end() ? planes.emplace_back() : *same;
    plane.normal += sample.area * sample.normal;
    plane.middle = (plane.area * plane.middle + sample.area * sample.point) / (plane.area + sample.area);
    plane.area += sample.area;
    plane.points.push_back(sample.point);
  }
  for (auto& plane : planes) plane.normal.normalize();
  std::stable_sort(planes.begin(), planes.end(), [](const auto& a, const auto& b) { return a.area > b.area; });
  return planes;
}

namespace {

// A few points of each patch of a surface, with the place that they were seen from. `area`: of all patches [m^2].
void addSamples(const std::vector<SurfacePatch>& patches, double area, const Vector3d& normal,
                const map::KeyFrames& key_frames, const Vector3d& sensor_in_base, std::vector<SurfaceSample>& samples) {
  constexpr std::size_t kOfPatch = 4;
  for (const auto& patch : patches) {
    const auto* frame = key_frames.find(patch.frame);
    const auto& outline = patch.outlineInBase();
    if (!frame || outline.size() < 3) continue;
    const Se3 pose = geometry::fromMrpt(frame->map_from_base);
    Vector3d middle = Vector3d::Zero();
    for (const auto& corner : outline) middle += corner / static_cast<double>(outline.size());
    const std::size_t every = std::max<std::size_t>(1, outline.size() / kOfPatch);
    const double share = static_cast<double>(every) / static_cast<double>(outline.size() * patches.size());
    for (std::size_t i = 0; i < outline.size(); i += every)
      samples.push_back({pose * (0.5 * (middle + outline[i])), normal, pose * sensor_in_base, share * area});
  }
}

// The part of a plane that a session has seen.
surfaces::CellGrid gridOf(const SeenPlane& plane) {
  constexpr double kCell = 0.25;  // [m]
  if (!(extentOf(plane.points) < kLargestCounted)) return {};
  auto grid = surfaces::CellGrid::around(geometry::Plane3::through(plane.middle, plane.normal), plane.points, kCell);
  for (const auto& point : plane.points)
    if (const auto cell = grid.cellAt(point)) grid.set(*cell);
  return grid;
}

}  // namespace

KnownSurfaces::KnownSurfaces(const PlaneLandmarkIndex& known, std::uint16_t session, const map::KeyFrames& key_frames,
                             const Vector3d& sensor_in_base) {
  for (const auto& [id, surface] : known.all()) {
    const auto& payload = dynamic_cast<const PlanePayload&>(*surface.payload);
    if (id.session == session || payload.is_candidate) continue;
    std::vector<SurfacePatch> earlier;
    for (const auto& patch : payload.patches)
      if (patch.frame.session != session) earlier.push_back(patch);
    const surfaces::CellGrid* seen = &surface.seen;
    if (earlier.size() < payload.patches.size()) {
      seen = &grids_.emplace_back();
      addSeen(grids_.back(), surface.plane, earlier, key_frames);
    }
    const double area = seen->area();
    if (!(area > 0)) continue;
    parts_.push_back({surface.plane, seen, area});
    addSamples(earlier, area, surface.plane.normal, key_frames, sensor_in_base, samples_);
  }
}

const Part* KnownSurfaces::under(const SurfaceSample& sample) const {
  const Part* nearest = nullptr;
  double distance = kOnSurface;
  for (const auto& part : parts_) {
    if (part.plane.normal.dot(sample.normal) < kParallel) continue;
    const double off = std::abs(signedDistance(part.plane, sample.point));
    if (off >= distance || !part.wasSeenNear(sample.point)) continue;
    nearest = &part;
    distance = off;
  }
  return nearest;
}

SurfaceAgreement KnownSurfaces::compare(const std::vector<SurfaceSample>& samples, const Se3& map_from_samples) const {
  SurfaceAgreement agreement;
  for (const auto& sample : samples) {
    const SurfaceSample in_map = map_from_samples * sample;
    agreement.all += sample.area;
    if (under(in_map)) {
      agreement.agrees += sample.area;
      agreement.held += sample.area * in_map.normal * in_map.normal.transpose();
    } else if (std::any_of(parts_.begin(), parts_.end(),
                           [&](const Part& part) { return isSeenThrough(part.plane, *part.seen, in_map); })) {
      agreement.contradicts += sample.area;
    }
  }
  const Se3 samples_from_map = inverse(map_from_samples);
  for (const auto& plane : seenPlanesOf(samples)) {
    const auto in_samples = geometry::Plane3::through(plane.middle, plane.normal);
    const auto grid = gridOf(plane);
    for (const auto& sample : samples_)
      if (isSeenThrough(in_samples, grid, samples_from_map * sample)) agreement.contradicts += sample.area;
  }
  return agreement;
}

Se3 KnownSurfaces::settled(const std::vector<SurfaceSample>& samples, Se3 map_from_samples, bool planar) const {
  constexpr int kRounds = 4;
  for (int round = 0; round < kRounds; ++round) {
    // Of a change (t, w) about the mean of the samples, in the map: distance + n.t + (p - mean) x n . w = 0.
    Vector3d mean = Vector3d::Zero();
    std::vector<std::pair<SurfaceSample, const Part*>> on;
    for (const auto& sample : samples) {
      const SurfaceSample in_map = map_from_samples * sample;
      if (const auto* part = under(in_map)) on.emplace_back(in_map, part);
    }
    if (on.empty()) return map_from_samples;
    for (const auto& [sample, part] : on) mean += sample.point / static_cast<double>(on.size());
    geometry::Matrix6d information = geometry::Matrix6d::Identity() * 1e-3;
    geometry::Vector6d gradient = geometry::Vector6d::Zero();
    for (const auto& [sample, part] : on) {
      geometry::Vector6d by;
      by << part->plane.normal, (sample.point - mean).cross(part->plane.normal);
      if (planar) by[2] = by[3] = by[4] = 0;
      information += sample.area * by * by.transpose();
      gradient += sample.area * by * signedDistance(part->plane, sample.point);
    }
    const geometry::Vector6d change = -information.ldlt().solve(gradient);
    const Eigen::Quaterniond turn = geometry::expSo3(change.tail<3>());
    map_from_samples = Se3{turn, mean + change.head<3>() - turn * mean} * map_from_samples;
  }
  return map_from_samples;
}

}  // namespace omnimapper::plugins
