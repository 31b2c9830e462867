#include "LevelSurfaces.h"

#include <omnimapper/geometry/Conversions.h>

#include <algorithm>
#include <cmath>

namespace omnimapper::plugins {

namespace {

double heightOf(const surfaces::Surface& surface) {
  double sum = 0;
  const auto corners = cornersOf(surface);
  for (const auto& corner : corners) sum += corner.z();
  return corners.empty() ? 0 : sum / static_cast<double>(corners.size());
}

}  // namespace

void LevelSurfaces::add(const surfaces::Surface& in_map) {
  surfaces_.push_back(in_map);
  if (!level_ || !level_->isKnown() || level_->up == Eigen::Vector3d::UnitZ()) return;
  const geometry::Se3 level_from_map{level_->levelFromMap(), Eigen::Vector3d::Zero()};
  surfaces::Surface& surface = surfaces_.back();
  surface.plane = level_from_map * surface.plane;
  for (auto& part : surface.parts) {
    for (auto& corner : part.outline) corner = level_from_map * corner;
    for (auto& hole : part.holes)
      for (auto& corner : hole) corner = level_from_map * corner;
  }
}

std::vector<surfaces::Judgement> LevelSurfaces::judged(PlaneLandmarksOptions::Ground ground,
                                                       const map::KeyFrames& key_frames) const {
  if (level_ && !level_->isKnown())
    return {surfaces_.size(), {surfaces::SurfaceClass::surface, "which way is up is not known"}};
  return surfaces::classify(surfaces_, floor(ground, key_frames));
}

// Whether z of the map is up; true, too, if nothing is known of its level.
bool LevelSurfaces::isMapLevel() const {
  constexpr double kLevel = 0.996;  // cosine of 5 deg
  return !level_ || level_->up.z() > kLevel;
}

double LevelSurfaces::floor(PlaneLandmarksOptions::Ground ground, const map::KeyFrames& key_frames) const {
  using Ground = PlaneLandmarksOptions::Ground;
  if (ground == Ground::map && isMapLevel()) return 0;
  const bool stands_on_it = !level_ || level_->source == map::Level::Source::base;
  if (stands_on_it && key_frames.empty()) return 0;
  if (stands_on_it) {
    const Eigen::Vector3d start = geometry::fromMrpt(key_frames.front().map_from_base).translation;
    return level_ ? (level_->levelFromMap() * start).z() : start.z();
  }
  constexpr double kLevelNormal = 0.95, kLarge = 0.5, kApart = 0.1;  // z of the normal, [m^2], [m]
  std::vector<std::pair<double, double>> heights;                    // and areas
  double lowest = HUGE_VAL;
  for (const auto& surface : surfaces_) {
    for (const auto& corner : cornersOf(surface)) lowest = std::min(lowest, corner.z());
    if (surface.plane.normal.z() > kLevelNormal) heights.emplace_back(heightOf(surface), areaOf(surface));
  }
  std::sort(heights.begin(), heights.end());
  // Parts of one floor are added up.
  for (std::size_t begin = 0; begin < heights.size(); ++begin) {
    double area = 0, sum = 0;
    for (std::size_t i = begin; i < heights.size() && heights[i].first < heights[begin].first + kApart; ++i) {
      area += heights[i].second;
      sum += heights[i].second * heights[i].first;
    }
    if (area >= kLarge) return sum / area;
  }
  return std::isfinite(lowest) ? lowest : 0;
}

}  // namespace omnimapper::plugins
