#include "CornerAlignment.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>

namespace omnimapper::calibration {

namespace {

constexpr int kRadius = 6, kSide = 2 * kRadius + 1;  // [px]
using Patch = std::array<double, kSide * kSide>;

// Grey level, interpolated between pixels; none outside the picture.
std::optional<double> greyAt(const CalibrationView& view, const Eigen::Vector2d& p) {
  const int x = static_cast<int>(std::floor(p.x())), y = static_cast<int>(std::floor(p.y()));
  if (x < 0 || y < 0 || x + 1 >= view.width || y + 1 >= view.height) return std::nullopt;
  const double u = p.x() - x, v = p.y() - y;
  const auto at = [&](int column, int row) {
    return static_cast<double>(view.grey[static_cast<std::size_t>(row) * static_cast<std::size_t>(view.width) +
                                         static_cast<std::size_t>(column)]);
  };
  return (1 - v) * ((1 - u) * at(x, y) + u * at(x + 1, y)) + v * ((1 - u) * at(x, y + 1) + u * at(x + 1, y + 1));
}

// The grey levels of `view` around a place; `step` rotates and stretches the patch.
std::optional<Patch> patchAt(const CalibrationView& view, const Eigen::Vector2d& place, const Eigen::Matrix2d& step) {
  Patch patch;
  std::size_t i = 0;
  for (int row = -kRadius; row <= kRadius; ++row) {
    for (int column = -kRadius; column <= kRadius; ++column, ++i) {
      const auto grey = greyAt(view, place + step * Eigen::Vector2d(column, row));
      if (!grey) return std::nullopt;
      patch[i] = *grey;
    }
  }
  return patch;
}

// Rotation and stretching of the surroundings of a pixel of `from` when they are seen in `to`, by the surface there.
std::optional<Eigen::Matrix2d> warpOf(const CalibrationView& from, const Eigen::Vector2d& pixel,
                                      const CalibrationView& to, const DepthCamera& camera) {
  constexpr double kStep = 4;  // [px]
  const auto place = depthPixelOf(from, camera, pixel);
  const auto plane = place ? from.planeAt(*place) : std::nullopt;
  if (!plane) return std::nullopt;
  const double columns_per_pixel = camera.depthCamera()[0] / camera.picture[0];
  const auto to_from_from = inverse(to.world_from_picture) * from.world_from_picture;
  const auto projected = [&](const Eigen::Vector2d& off) -> std::optional<Eigen::Vector2d> {
    const double inverse_depth = plane->at(*place + columns_per_pixel * off) / camera.depth_scale;
    if (!(inverse_depth > 0.05)) return std::nullopt;
    const Eigen::Vector3d p = to_from_from * Eigen::Vector3d(rayThrough(camera.picture, pixel + off) / inverse_depth);
    if (!(p.z() > 0.1)) return std::nullopt;
    return Eigen::Vector2d(project(camera.picture.data(), p));
  };
  const auto middle = projected({0, 0}), right = projected({kStep, 0}), below = projected({0, kStep});
  if (!middle || !right || !below) return std::nullopt;
  Eigen::Matrix2d warp;
  warp << (*right - *middle) / kStep, (*below - *middle) / kStep;
  const double area = std::abs(warp.determinant());
  constexpr double kMostStretched = 2.5;
  if (!(area > 1 / kMostStretched && area < kMostStretched)) return std::nullopt;
  return warp;
}

struct Aligned {
  Eigen::Vector2d pixel;
  double likeness;  ///< correlation of the grey levels
};

// Aligns with Lucas and Kanade's method, over shift, contrast and brightness.
std::optional<Aligned> align(const Patch& reference, const CalibrationView& view, const Eigen::Vector2d& start,
                             const Eigen::Matrix2d& warp) {
  constexpr int kRounds = 20;
  constexpr double kDone = 0.005, kFarthest = 3;  // [px]
  Eigen::Vector2d place = start;
  double gain = 1, offset = 0, likeness = 0;
  for (int round = 0; round < kRounds; ++round) {
    const auto here = patchAt(view, place, warp);
    const auto right = patchAt(view, place + Eigen::Vector2d(0.5, 0), warp),
               left = patchAt(view, place - Eigen::Vector2d(0.5, 0), warp);
    const auto below = patchAt(view, place + Eigen::Vector2d(0, 0.5), warp),
               above = patchAt(view, place - Eigen::Vector2d(0, 0.5), warp);
    if (!here || !right || !left || !below || !above) return std::nullopt;
    Eigen::Matrix4d normal = Eigen::Matrix4d::Zero();
    Eigen::Vector4d rhs = Eigen::Vector4d::Zero();
    double sum_a = 0, sum_b = 0, sum_aa = 0, sum_bb = 0, sum_ab = 0;
    for (std::size_t i = 0; i < reference.size(); ++i) {
      const Eigen::Vector4d a((*right)[i] - (*left)[i], (*below)[i] - (*above)[i], -reference[i], -1);
      const double miss = (*here)[i] - gain * reference[i] - offset;
      normal += a * a.transpose();
      rhs -= miss * a;
      sum_a += reference[i];
      sum_b += (*here)[i];
      sum_aa += reference[i] * reference[i];
      sum_bb += (*here)[i] * (*here)[i];
      sum_ab += reference[i] * (*here)[i];
    }
    const double n = static_cast<double>(reference.size());
    const double spread = (sum_aa - sum_a * sum_a / n) * (sum_bb - sum_b * sum_b / n);
    likeness = spread > 0 ? (sum_ab - sum_a * sum_b / n) / std::sqrt(spread) : 0;
    const Eigen::Vector4d change = normal.ldlt().solve(rhs);
    if (!change.allFinite()) return std::nullopt;
    place += change.head<2>();
    gain += change[2];
    offset += change[3];
    if (!((place - start).norm() < kFarthest)) return std::nullopt;
    if (change.head<2>().norm() < kDone) break;
  }
  return Aligned{place, likeness};
}

// The view in the middle of the track is the reference, because it is closest to all others.
void alignTrack(Track& track, const std::vector<CalibrationView>& views, const DepthCamera& camera) {
  constexpr double kLeastLikeness = 0.85, kSigma = 0.35;  // [-] [px] of an aligned corner
  const CornerMeasurement reference = track.measurements[track.measurements.size() / 2];
  const auto patch = patchAt(views[reference.view], reference.pixel, Eigen::Matrix2d::Identity());
  std::vector<CornerMeasurement> kept;
  for (const auto& measurement : track.measurements) {
    if (!patch) break;
    if (measurement.view == reference.view) {
      kept.push_back({measurement.view, measurement.pixel, kSigma});
      continue;
    }
    const auto warp = warpOf(views[reference.view], reference.pixel, views[measurement.view], camera);
    const auto aligned = warp ? align(*patch, views[measurement.view], measurement.pixel, *warp) : std::nullopt;
    if (aligned && aligned->likeness > kLeastLikeness) kept.push_back({measurement.view, aligned->pixel, kSigma});
  }
  track.measurements = std::move(kept);
}

}  // namespace

void alignCorners(std::vector<Track>& tracks, const std::vector<CalibrationView>& views, const DepthCamera& camera,
                  std::size_t fewest) {
  for (auto& track : tracks) alignTrack(track, views, camera);
  tracks.erase(std::remove_if(tracks.begin(), tracks.end(),
                              [&](const Track& track) { return track.measurements.size() < fewest; }),
               tracks.end());
}

}  // namespace omnimapper::calibration
