#include "SurfaceAgreement.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "PlaneExtent.h"

namespace omnimapper::plugins {

using Eigen::Vector3d;
using geometry::Se3;
using Surface = PlaneLandmarkIndex::Surface;

namespace {

constexpr double kOnSurface = 0.1;  // [m] from a surface to a sample that lies on it
constexpr double kParallel = 0.94;  // cosine of 20 deg: normals of one surface

bool wasSeenAt(const Surface& surface, const Vector3d& point) {
  const auto cell = surface.seen.cellAt(point);
  return cell && surface.seen.isSet(*cell);
}

// At an edge, a ray may pass beside the real surface.
bool wasSeenAround(const Surface& surface, const Vector3d& point) {
  constexpr double kEdge = 0.15;  // [m]
  const Vector3d u = kEdge * surface.seen.u(), v = kEdge * surface.seen.v();
  return wasSeenAt(surface, point) && wasSeenAt(surface, point + u) && wasSeenAt(surface, point - u) &&
         wasSeenAt(surface, point + v) && wasSeenAt(surface, point - v);
}

// Whether the ray from the sensor to the sample passes through the surface.
bool isSeenThrough(const Surface& surface, const SurfaceSample& sample) {
  constexpr double kThick = 0.25, kSensor = 0.05;  // [m]
  const double before = signedDistance(surface.plane, sample.sensor),
               behind = signedDistance(surface.plane, sample.point);
  if (before * behind >= 0 || std::abs(before) < kSensor || std::abs(behind) < kThick) return false;
  return wasSeenAround(surface, sample.sensor + before / (before - behind) * (sample.point - sample.sensor));
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
  if (planar) return Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(held.topLeftCorner<2, 2>()).eigenvalues()[0];
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(held).eigenvalues()[0];
}

bool wasSeenNear(const Surface& surface, const Vector3d& point) {
  constexpr double kNear = 0.1;  // [m]
  const Vector3d u = kNear * surface.seen.u(), v = kNear * surface.seen.v();
  return wasSeenAt(surface, point) || wasSeenAt(surface, point + u) || wasSeenAt(surface, point - u) ||
         wasSeenAt(surface, point + v) || wasSeenAt(surface, point - v);
}

KnownSurfaces::KnownSurfaces(const PlaneLandmarkIndex& known, std::uint16_t session) {
  for (const auto& [id, surface] : known.all()) {
    if (id.session == session || dynamic_cast<const PlanePayload&>(*surface.payload).is_candidate) continue;
    if (surface.seen.count() > 0) surfaces_.push_back(&surface);
  }
}

const Surface* KnownSurfaces::under(const SurfaceSample& sample) const {
  const Surface* nearest = nullptr;
  double distance = kOnSurface;
  for (const auto* surface : surfaces_) {
    if (surface->plane.normal.dot(sample.normal) < kParallel) continue;
    const double off = std::abs(signedDistance(surface->plane, sample.point));
    if (off >= distance || !wasSeenNear(*surface, sample.point)) continue;
    nearest = surface;
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
    } else if (std::any_of(surfaces_.begin(), surfaces_.end(),
                           [&](const auto* surface) { return isSeenThrough(*surface, in_map); })) {
      agreement.contradicts += sample.area;
    }
  }
  return agreement;
}

Se3 KnownSurfaces::settled(const std::vector<SurfaceSample>& samples, Se3 map_from_samples, bool planar) const {
  constexpr int kRounds = 4;
  for (int round = 0; round < kRounds; ++round) {
    // Of a change (t, w) about the mean of the samples, in the map: distance + n.t + (p - mean) x n . w = 0.
    Vector3d mean = Vector3d::Zero();
    std::vector<std::pair<SurfaceSample, const Surface*>> on;
    for (const auto& sample : samples) {
      const SurfaceSample in_map = map_from_samples * sample;
      if (const auto* surface = under(in_map)) on.emplace_back(in_map, surface);
    }
    if (on.empty()) return map_from_samples;
    for (const auto& [sample, surface] : on) mean += sample.point / static_cast<double>(on.size());
    geometry::Matrix6d information = geometry::Matrix6d::Identity() * 1e-3;
    geometry::Vector6d gradient = geometry::Vector6d::Zero();
    for (const auto& [sample, surface] : on) {
      geometry::Vector6d by;
      by << surface->plane.normal, (sample.point - mean).cross(surface->plane.normal);
      if (planar) by[2] = by[3] = by[4] = 0;
      information += sample.area * by * by.transpose();
      gradient += sample.area * by * signedDistance(surface->plane, sample.point);
    }
    const geometry::Vector6d change = -information.ldlt().solve(gradient);
    const Eigen::Quaterniond turn = geometry::expSo3(change.tail<3>());
    map_from_samples = Se3{turn, mean + change.head<3>() - turn * mean} * map_from_samples;
  }
  return map_from_samples;
}

}  // namespace omnimapper::plugins
