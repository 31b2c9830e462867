#include "Walls.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace omnimapper::building {

namespace {

/// Lines of faces while they are collected. The line of a wall runs inside it, behind its faces.
class WallCollector {
 public:
  WallCollector(double cell, const SegmentationOptions& options)
      : cell_(cell),
        behind_(0.05 / cell),
        tolerance_(options.wall_offset / cell),
        farthest_((options.longest_opening + 1) / cell) {}

  void add(const Face& face) {
    Growing* best = nullptr;
    double smallest = std::numeric_limits<double>::infinity();
    for (Growing& growing : growing_) {
      const double offset = offsetFrom(growing.wall, face);
      if (offset < smallest) {
        smallest = offset;
        best = &growing;
      }
    }
    if (best == nullptr) best = &growing_.emplace_back();
    best->faces.push_back(face);
    refit(*best);
  }

  std::vector<Wall> walls() const {
    std::vector<Wall> walls;
    for (const Growing& growing : growing_) walls.push_back(growing.wall);
    return walls;
  }

 private:
  struct Growing {
    Wall wall;
    std::vector<Face> faces;
  };

  /// Distance of a face from the line of a wall; infinite if the face does not continue it.
  double offsetFrom(const Wall& wall, const Face& face) const {
    constexpr double kNo = std::numeric_limits<double>::infinity();
    const cv::Point2d along = (face.to - face.from) / face.length;
    // The direction of a short face is less certain [rad].
    const double largest_angle = std::min(0.35, 0.05 + 0.06 / (face.length * cell_));
    if (std::abs(along.cross(wall.direction)) > std::sin(largest_angle)) return kNo;
    const auto distance = [&](const cv::Point2d& end) {
      return std::abs(wall.direction.cross(end + face.inward * behind_ - wall.origin));
    };
    const double offset = std::max(distance(face.from), distance(face.to));
    if (offset > tolerance_) return kNo;
    const double place = wall.direction.dot(0.5 * (face.from + face.to) - wall.origin);
    double gap = kNo;
    for (const auto& part : wall.parts)
      gap = std::min(gap, std::max({0.0, part.from - place, place - part.to}) - 0.5 * face.length);
    return gap > farthest_ ? kNo : offset;
  }

  void refit(Growing& growing) const {
    double weight = 0, xx = 0, xy = 0, yy = 0;
    cv::Point2d middle(0, 0);
    for (const Face& face : growing.faces) {
      middle += (0.5 * (face.from + face.to) + face.inward * behind_) * face.length;
      weight += face.length;
    }
    middle *= 1 / weight;
    for (const Face& face : growing.faces) {
      for (const double share : {0.0, 0.5, 1.0}) {
        const cv::Point2d point = face.from + (face.to - face.from) * share + face.inward * behind_ - middle;
        xx += face.length * point.x * point.x;
        xy += face.length * point.x * point.y;
        yy += face.length * point.y * point.y;
      }
    }
    const double angle = 0.5 * std::atan2(2 * xy, xx - yy);
    growing.wall = {middle, {std::cos(angle), std::sin(angle)}, {}, weight};
    for (const Face& face : growing.faces) {
      const double a = growing.wall.direction.dot(face.from - middle), b = growing.wall.direction.dot(face.to - middle);
      growing.wall.parts.push_back({std::min(a, b), std::max(a, b)});
    }
  }

  double cell_, behind_, tolerance_, farthest_;
  std::vector<Growing> growing_;
};

}  // namespace

std::vector<Wall> wallsOf(std::vector<Face> faces, double cell, const SegmentationOptions& options) {
  std::stable_sort(faces.begin(), faces.end(), [](const Face& a, const Face& b) { return a.length > b.length; });
  WallCollector collector(cell, options);
  for (const Face& face : faces) collector.add(face);
  return collector.walls();
}

}  // namespace omnimapper::building
