#include "ObjectModel.h"

#include <omnimapper/camera/DepthNoise.h>
#include <omnimapper/geometry/Conversions.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "PointGrid.h"

namespace omnimapper::plugins {

namespace {

geometry::Se3 poseOfView(const ObjectView& view, const map::KeyFrames& key_frames) {
  return geometry::fromMrpt(key_frames.at(view.frame).map_from_base);
}

ObjectPoints inMap(const ObjectView& view, const map::KeyFrames& key_frames) {
  const auto map_from_base = poseOfView(view, key_frames);
  const Eigen::Matrix3f turn = map_from_base.rotation.toRotationMatrix().cast<float>();
  const Eigen::Vector3f move = map_from_base.translation.cast<float>();
  ObjectPoints points;
  points.reserve(view.points.size());
  for (const auto& point : view.points) points.emplace_back(turn * point + move);
  return points;
}

// [m] ObjectPoints of a view that are nearer to one another than this may be of one place: three standard deviations.
double blurOf(const ObjectView& view, const ModelLimits& limits) {
  return std::max(limits.voxel, 3 * camera::DepthNoise().sigma * view.distance * view.distance);
}

template <class Keeps>
void keepPoints(ObjectView& view, const Keeps& keeps) {
  const bool coloured = view.colours.size() == view.points.size();
  std::size_t kept = 0;
  for (std::size_t i = 0; i < view.points.size(); ++i) {
    if (!keeps(i)) continue;
    view.points[kept] = view.points[i];
    if (coloured) view.colours[kept] = view.colours[i];
    ++kept;
  }
  view.points.resize(kept);
  view.colours.resize(coloured ? kept : 0);
}

void thinTo(ObjectView& view, std::size_t count) {
  const std::size_t all = view.points.size();
  if (count >= all) return;
  keepPoints(view, [&](std::size_t i) { return (i + 1) * count / all != i * count / all; });
}

// The value that a share of the values is below.
float quantile(std::vector<float>& values, double share) {
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1) + 0.5);
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

struct Span {
  double low, high;
  double length() const { return high - low; }
};

// Of the points along a unit vector, without those at the ends.
Span spanAlong(const ObjectPoints& points, const Eigen::Vector3d& axis, double share) {
  std::vector<float> along;
  along.reserve(points.size());
  const Eigen::Vector3f direction = axis.cast<float>();
  for (const auto& point : points) along.push_back(direction.dot(point));
  const double low = quantile(along, share);
  return {low, quantile(along, 1 - share)};
}

}  // namespace

std::size_t ObjectModel::size() const {
  return std::accumulate(views_.begin(), views_.end(), std::size_t{0},
                         [](std::size_t sum, const ObjectView& view) { return sum + view.points.size(); });
}

bool ObjectModel::standsOnSurface() const {
  return std::any_of(views_.begin(), views_.end(), [](const ObjectView& view) { return view.foot.has_value(); });
}

ObjectModel ObjectModel::with(ObjectView view, const map::KeyFrames& key_frames, const ModelLimits& limits) const {
  std::vector<ObjectView> views = views_;
  views.push_back(std::move(view));
  std::stable_sort(views.begin(), views.end(), [](const auto& a, const auto& b) { return a.distance < b.distance; });
  const auto most_views = static_cast<std::size_t>(limits.max_views);
  if (views.size() > most_views) views.erase(views.begin() + static_cast<std::ptrdiff_t>(most_views), views.end());
  ObjectPoints nearer;  // of the views before
  for (auto& each : views) {
    const PointGrid taken(blurOf(each, limits), nearer);
    PointGrid own(limits.voxel);
    const ObjectPoints points = inMap(each, key_frames);
    std::vector<bool> keeps;
    for (const auto& point : points) {
      keeps.push_back(!taken.has(point) && own.add(point));
      if (keeps.back()) nearer.push_back(point);
    }
    keepPoints(each, [&](std::size_t i) { return keeps[i]; });
  }
  views.erase(std::remove_if(views.begin(), views.end(), [](const auto& each) { return each.points.empty(); }),
              views.end());
  ObjectModel model(std::move(views));
  const std::size_t all = model.size(), most = static_cast<std::size_t>(limits.max_points);
  if (all > most)
    for (auto& each : model.views_) thinTo(each, std::max<std::size_t>(1, each.points.size() * most / all));
  return model;
}

ObjectModel ObjectModel::seenFrom(const std::set<base::KeyFrameId>& frames) const {
  std::vector<ObjectView> views;
  for (const auto& view : views_)
    if (frames.count(view.frame) > 0) views.push_back(view);
  return ObjectModel(std::move(views));
}

ObjectModel ObjectModel::kept(const std::vector<bool>& keeps) const {
  std::vector<ObjectView> views = views_;
  std::size_t first = 0;
  for (auto& view : views) {
    const std::size_t count = view.points.size();
    keepPoints(view, [&](std::size_t i) { return keeps[first + i]; });
    first += count;
  }
  views.erase(std::remove_if(views.begin(), views.end(), [](const auto& view) { return view.points.empty(); }),
              views.end());
  return ObjectModel(std::move(views));
}

ObjectPoints ObjectModel::pointsInMap(const map::KeyFrames& key_frames) const {
  ObjectPoints all;
  all.reserve(size());
  for (const auto& view : views_) {
    const ObjectPoints points = inMap(view, key_frames);
    all.insert(all.end(), points.begin(), points.end());
  }
  return all;
}

std::vector<obs::Rgb> ObjectModel::colours() const {
  constexpr obs::Rgb kUnknown{128, 128, 128};
  std::vector<obs::Rgb> all;
  all.reserve(size());
  for (const auto& view : views_) {
    all.insert(all.end(), view.colours.begin(), view.colours.end());
    if (view.colours.empty()) all.insert(all.end(), view.points.size(), kUnknown);
  }
  return all;
}

Eigen::Vector3d ObjectModel::upInMap(const map::KeyFrames& key_frames) const {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const auto& view : views_) sum += poseOfView(view, key_frames).rotation * view.up;
  return sum.norm() > 1e-3 ? sum.normalized() : Eigen::Vector3d::UnitZ();
}

std::optional<Eigen::Vector3d> ObjectModel::footInMap(const map::KeyFrames& key_frames) const {
  const ObjectView* nearest = nullptr;
  for (const auto& view : views_)
    if (view.foot && (nearest == nullptr || view.distance < nearest->distance)) nearest = &view;
  if (nearest == nullptr) return std::nullopt;
  return poseOfView(*nearest, key_frames) * *nearest->foot;
}

std::optional<map::Box> ObjectModel::box(const map::KeyFrames& key_frames) const {
  const ObjectPoints points = pointsInMap(key_frames);
  if (points.empty()) return std::nullopt;
  const Eigen::Vector3d up = upInMap(key_frames);
  map::Box box = boxAround(points, up);
  const auto foot = footInMap(key_frames);
  if (!foot) return box;
  const double bottom = up.dot(box.middle) - 0.5 * box.size.z(), gap = bottom - up.dot(*foot);
  if (gap <= 0 || gap > kLostFoot) return box;
  box.size.z() += gap;
  box.middle -= 0.5 * gap * up;
  return box;
}

map::Box boxAround(const ObjectPoints& points, const Eigen::Vector3d& up) {
  constexpr double kStep = 3 * EIGEN_PI / 180, kLeast = 0.001;
  constexpr std::size_t kMany = 200;
  const double share = points.size() > kMany ? 1.0 / static_cast<double>(kMany) : 0;
  const Eigen::Matrix3d axes = Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), up).toRotationMatrix();
  const auto axisAt = [&](double angle) -> Eigen::Vector3d {
    return std::cos(angle) * axes.col(0) + std::sin(angle) * axes.col(1);
  };
  double best = 0, least = std::numeric_limits<double>::infinity();
  for (int step = 0; step < 30; ++step) {
    const double angle = step * kStep;
    const double area = spanAlong(points, axisAt(angle), share).length() *
                        spanAlong(points, axisAt(angle + EIGEN_PI / 2), share).length();
    if (area >= least) continue;
    least = area;
    best = angle;
  }
  Eigen::Matrix3d turn;
  turn << axisAt(best), axisAt(best + EIGEN_PI / 2), axes.col(2);
  map::Box box;
  for (int axis = 0; axis < 3; ++axis) {
    const Span span = spanAlong(points, turn.col(axis), share);
    box.middle += 0.5 * (span.low + span.high) * turn.col(axis);
    box.size[axis] = std::max(kLeast, span.length());
  }
  box.map_from_box = Eigen::Quaterniond(turn);
  return box;
}

}  // namespace omnimapper::plugins
