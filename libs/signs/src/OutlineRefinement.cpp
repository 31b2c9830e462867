#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <optional>

#include "PlateOutlines.h"

namespace omnimapper::signs {

namespace {

using Eigen::Vector2f;

constexpr int kAlongSide = 32;      // places along a side at which its edge is sought
constexpr int kLongestReach = 24;   // [px] largest distance at which an edge is sought
constexpr float kTolerance = 1.5f;  // [px] largest distance of a point from the line that is fitted to a side

struct Line {
  Vector2f point, direction;
};

// Distance [px] from a place on a side, along its normal, at which the colours change most; none if they hardly change.
std::optional<float> strongestChange(const cv::Mat& picture, const Vector2f& at, const Vector2f& normal, int reach) {
  constexpr float kLeast = 4;  // grey levels per pixel, in the channel that changes most
  float best = 0, best_change = kLeast;
  for (int step = -reach; step <= reach; ++step) {
    const Vector2f before = at + static_cast<float>(step - 1) * normal,
                   after = at + static_cast<float>(step + 1) * normal;
    const cv::Point a(cvRound(before.x()), cvRound(before.y())), b(cvRound(after.x()), cvRound(after.y()));
    const cv::Rect all({0, 0}, picture.size());
    if (!all.contains(a) || !all.contains(b)) continue;
    const auto &p = picture.at<cv::Vec3b>(a), &q = picture.at<cv::Vec3b>(b);
    float change = 0;
    for (int i = 0; i < 3; ++i) change = std::max(change, 0.5f * static_cast<float>(std::abs(p[i] - q[i])));
    if (change > best_change) {
      best = static_cast<float>(step);
      best_change = change;
    }
  }
  return best_change > kLeast ? std::optional(best) : std::nullopt;
}

Line sideLine(const cv::Mat& picture, const Vector2f& from, const Vector2f& to, int reach) {
  const Vector2f along = to - from;
  const Line unchanged{from, along};
  if (along.norm() < 1) return unchanged;
  const Vector2f normal = Vector2f(-along.y(), along.x()).normalized();
  std::vector<Vector2f> points;  // share of the side, offset along the normal
  for (int i = 0; i < kAlongSide; ++i) {
    const float share = 0.05f + 0.9f * static_cast<float>(i) / (kAlongSide - 1);
    if (const auto offset = strongestChange(picture, from + share * along, normal, reach))
      points.emplace_back(share, *offset);
  }
  // Takes the line through two of the points that has most points near it, then the least-squares line of these.
  std::size_t most = 0;
  Vector2f best(0, 0);  // offset at the beginning and at the end
  const auto isNear = [](const Vector2f& ends, const Vector2f& point) {
    return std::abs(ends.x() + point.x() * (ends.y() - ends.x()) - point.y()) <= kTolerance;
  };
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t k = i + points.size() / 4 + 1; k < points.size(); ++k) {
      const float slope = (points[k].y() - points[i].y()) / (points[k].x() - points[i].x());
      const Vector2f ends(points[i].y() - points[i].x() * slope, points[i].y() + (1 - points[i].x()) * slope);
      const auto count = static_cast<std::size_t>(
          std::count_if(points.begin(), points.end(), [&](const auto& point) { return isNear(ends, point); }));
      if (count > most) {
        most = count;
        best = ends;
      }
    }
  }
  if (2 * most < kAlongSide) return unchanged;
  float n = 0, x = 0, y = 0, xx = 0, xy = 0;
  for (const auto& point : points) {
    if (!isNear(best, point)) continue;
    n += 1;
    x += point.x();
    y += point.y();
    xx += point.x() * point.x();
    xy += point.x() * point.y();
  }
  const float slope = (n * xy - x * y) / (n * xx - x * x), offset = (y - slope * x) / n;
  return {from + offset * normal, along + slope * normal};
}

std::optional<Vector2f> crossing(const Line& a, const Line& b) {
  const float area = a.direction.x() * b.direction.y() - a.direction.y() * b.direction.x();
  if (std::abs(area) < 1e-3f * a.direction.norm() * b.direction.norm()) return std::nullopt;
  const Vector2f between = b.point - a.point;
  return a.point + (between.x() * b.direction.y() - between.y() * b.direction.x()) / area * a.direction;
}

}  // namespace

Corners refined(const cv::Mat& picture, const Corners& outline, float reach) {
  const int steps = std::clamp(cvRound(reach), 1, kLongestReach);
  cv::Mat smooth;
  cv::Rect about = cv::boundingRect(std::vector<cv::Point2f>{{outline[0].x(), outline[0].y()},
                                                             {outline[1].x(), outline[1].y()},
                                                             {outline[2].x(), outline[2].y()},
                                                             {outline[3].x(), outline[3].y()}});
  about -= cv::Point(steps + 4, steps + 4);
  about += cv::Size(2 * steps + 8, 2 * steps + 8);
  about &= cv::Rect({0, 0}, picture.size());
  if (about.empty()) return outline;
  cv::GaussianBlur(picture(about), smooth, {}, 1);
  const Vector2f origin(static_cast<float>(about.x), static_cast<float>(about.y));
  std::array<Line, 4> sides;
  for (std::size_t i = 0; i < sides.size(); ++i)
    sides[i] = sideLine(smooth, outline[i] - origin, outline[(i + 1) % sides.size()] - origin, steps);
  Corners result = outline;
  for (std::size_t i = 0; i < sides.size(); ++i) {
    const auto corner = crossing(sides[(i + 3) % sides.size()], sides[i]);
    if (!corner) return outline;
    result[i] = *corner + origin;
  }
  return result;
}

}  // namespace omnimapper::signs
