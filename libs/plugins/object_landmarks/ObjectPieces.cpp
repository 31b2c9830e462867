#include "ObjectPieces.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <utility>

namespace omnimapper::plugins {

namespace {

using Eigen::Vector3d;

// [m] Height of the lowest or highest points along `up`, without the outermost 2 %.
double heightAt(const ObjectGeometry& object, const Vector3d& up, double share) {
  std::vector<float> heights;
  for (const auto& point : object.points) heights.push_back(up.cast<float>().dot(point));
  const auto at = heights.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(heights.size() - 1));
  std::nth_element(heights.begin(), at, heights.end());
  return *at;
}

double bottomOf(const ObjectGeometry& object, const Vector3d& up) {
  return heightAt(object, up, 0.02);
}

double topOf(const ObjectGeometry& object, const Vector3d& up) {
  return heightAt(object, up, 0.98);
}

double planArea(const map::Box& box) {
  return box.size.x() * box.size.y();
}

// The share of a box that lies in another one; `seen_from_above`: of its base, whatever the heights.
double shareInside(const map::Box& box, const map::Box& other, bool seen_from_above) {
  constexpr int kSteps = 10;  // along each side
  int inside = 0;
  for (int i = 0; i < kSteps * kSteps * kSteps; ++i) {
    const Eigen::Array3d at(i % kSteps, i / kSteps % kSteps, i / kSteps / kSteps);
    const Vector3d in_box = ((at + 0.5) / kSteps - 0.5) * box.size.array();
    const Vector3d in_map = box.middle + box.map_from_box * in_box;
    const Eigen::Array3d in_other = (other.map_from_box.conjugate() * (in_map - other.middle)).cwiseAbs();
    const Eigen::Array3d half = 0.5 * other.size.array();
    inside += in_other.x() <= half.x() && in_other.y() <= half.y() && (seen_from_above || in_other.z() <= half.z());
  }
  return inside / std::pow(kSteps, 3);
}

// How much two objects of which one is above the other touch: the larger share of points of either that are near the
// other, and at least a little where one ends at the height at which the other begins. 0 for objects side by side.
double touchingOf(const ObjectGeometry& a, const ObjectGeometry& b) {
  constexpr double kLeastAbove = 0.3, kMostlyAbove = 0.5, kGap = 0.03, kLittle = 0.03;  // [-], [-], [m], [-]
  const double above = std::max(shareInside(a.box, b.box, true), shareInside(b.box, a.box, true));
  if (above < kLeastAbove) return 0;
  const double gap = std::max(bottomOf(a, a.up) - topOf(b, a.up), bottomOf(b, a.up) - topOf(a, a.up));
  const double near = std::max(shareNear(b.grid, a.points), shareNear(a.grid, b.points));
  return above >= kMostlyAbove && gap <= kGap ? std::max(near, kLittle) : near;
}

// Whether both fill about the same volume.
bool fillOneVolume(const ObjectGeometry& a, const ObjectGeometry& b) {
  constexpr double kOfSmaller = 0.5, kOfLarger = 0.25;
  const double of_a = shareInside(a.box, b.box, false), of_b = shareInside(b.box, a.box, false);
  return std::max(of_a, of_b) >= kOfSmaller && std::min(of_a, of_b) >= kOfLarger;
}

// Whether the object reaches down to its surface, or there is none that is known.
bool standsOnSurface(const PieceCandidate& object) {
  return !object.height || *object.height <= ObjectModel::kLostFoot;
}

// Whether it is too thin for its height to stand by itself.
bool isPost(const map::Box& box) {
  constexpr double kSlender = 6;
  return box.size.z() > kSlender * std::max(box.size.x(), box.size.y());
}

constexpr double kSlice = 0.03;  // [m] height of what counts as the top or the base of an object

map::Box boxOfSlice(const ObjectGeometry& object, const Vector3d& up, double from, double to) {
  ObjectPoints slice;
  for (const auto& point : object.points) {
    const double height = up.cast<float>().dot(point);
    if (height >= from && height <= to) slice.push_back(point);
  }
  return slice.empty() ? map::Box() : boxAround(slice, up);
}

bool isOver(const Vector3d& point, const map::Box& box, double margin) {
  const Eigen::Array3d in_box = (box.map_from_box.conjugate() * (point - box.middle)).cwiseAbs();
  return in_box.x() <= 0.5 * box.size.x() + margin && in_box.y() <= 0.5 * box.size.y() + margin;
}

// Whether one could stand on the top of the other: a cup on a can, but no shade on a post, and no leaf that leans out.
bool standsOn(const ObjectGeometry& object, const ObjectGeometry& carrier) {
  constexpr double kMostWider = 9, kMargin = 0.02;  // [-] ratio of areas, [m]
  const Vector3d& up = object.up;
  const double bottom = bottomOf(object, up), top = topOf(carrier, up);
  if (isPost(object.box) || std::abs(bottom - top) > kSlice) return false;
  const map::Box top_of_carrier = boxOfSlice(carrier, up, top - kSlice, top + kSlice);
  const map::Box base = boxOfSlice(object, up, bottom - kSlice, bottom + kSlice);
  return planArea(object.box) <= kMostWider * planArea(top_of_carrier) &&
         isOver(object.box.middle, top_of_carrier, kMargin) && isOver(object.box.middle, base, kMargin);
}

class Grouping {
 public:
  explicit Grouping(const std::vector<PieceCandidate>& objects) : objects_(objects), group_(objects.size()) {
    std::iota(group_.begin(), group_.end(), std::size_t{0});
    for (std::size_t i = 0; i < objects.size(); ++i) joinPieceOf(i);
  }
  std::size_t groupOf(std::size_t i) const {
    while (group_[i] != i) i = group_[i];
    return i;
  }

 private:
  void joinPieceOf(std::size_t i) {
    const ObjectGeometry& object = objects_[i].geometry;
    bool stands = standsOnSurface(objects_[i]);
    std::vector<std::pair<double, std::size_t>> touched;
    for (std::size_t k = 0; k < objects_.size(); ++k) {
      const ObjectGeometry& other = objects_[k].geometry;
      if (k == i || !object.bounds.intersects(grown(other.bounds))) continue;
      stands = stands || standsOn(object, other);
      if (k > i && fillOneVolume(object, other)) join(i, k);
      constexpr double kLeastTouching = 0.02;
      if (const double touching = touchingOf(object, other); touching >= kLeastTouching)
        touched.emplace_back(touching, k);
    }
    if (stands || touched.empty()) return;
    // What carries it begins lower, if that was seen.
    constexpr double kLower = 0.03;  // [m]
    const auto isLower = [&](const auto& each) {
      const ObjectGeometry& other = objects_[each.second].geometry;
      return bottomOf(other, object.up) < bottomOf(object, object.up) - kLower;
    };
    const auto lower = std::stable_partition(touched.begin(), touched.end(), isLower);
    const auto end = lower == touched.begin() ? touched.end() : lower;
    join(i, std::max_element(touched.begin(), end)->second);
  }
  static Eigen::AlignedBox3f grown(const Eigen::AlignedBox3f& bounds) {
    constexpr auto kNear = static_cast<float>(ObjectGeometry::kNear);
    return {bounds.min().array() - kNear, bounds.max().array() + kNear};
  }
  // The group with the most points keeps its name: that of its largest object.
  void join(std::size_t a, std::size_t b) {
    std::size_t kept = groupOf(a), gone = groupOf(b);
    if (objects_[kept].geometry.points.size() < objects_[gone].geometry.points.size()) std::swap(kept, gone);
    group_[gone] = kept;
  }

  const std::vector<PieceCandidate>& objects_;
  std::vector<std::size_t> group_;  // an object of the same group, in the end the largest
};

}  // namespace

std::map<base::LandmarkId, base::LandmarkId> findPieces(const std::vector<PieceCandidate>& objects) {
  const Grouping grouping(objects);
  std::map<base::LandmarkId, base::LandmarkId> pieces;
  for (std::size_t i = 0; i < objects.size(); ++i)
    if (grouping.groupOf(i) != i) pieces[objects[i].id] = objects[grouping.groupOf(i)].id;
  return pieces;
}

}  // namespace omnimapper::plugins
