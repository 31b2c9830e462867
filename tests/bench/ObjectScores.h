#pragma once

#include <algorithm>
#include <map>
#include <vector>

#include "ObjectPeers.h"

namespace omnimapper::bench {

constexpr std::uint32_t kFirstObject = 20;  ///< labels from here on are those of objects
constexpr std::uint32_t kNeither =
    10;                          ///< label of furniture, which stands on the floor as objects do and is not counted
constexpr double kFewest = 300;  ///< least number of points of an object that counts
constexpr double kRight = 0.5;   ///< least intersection over union of a right detection

/// One detection, in any of the clouds.
struct Detection {
  std::size_t pixels;
  bool right;  // its intersection over union with an object is at least kRight
};

struct Result {
  std::vector<Detection> detections;
  int objects = 0, merged = 0;  // merged: objects that are mostly covered by one detection together with another object
  double overlap = 0;           // sum over objects of the best intersection over union
  std::vector<double> milliseconds;
};

inline void compare(const source::PcdCloud& cloud, const Objects& found, Result& result) {
  std::map<std::uint32_t, double> sizes;
  for (const auto label : cloud.labels) {
    if (label >= kFirstObject) ++sizes[label];
  }
  for (auto size = sizes.begin(); size != sizes.end();) size = size->second < kFewest ? sizes.erase(size) : ++size;
  std::map<std::uint32_t, double> best;
  std::map<std::uint32_t, std::size_t> covers;
  for (std::size_t i = 0; i < found.size(); ++i) {
    std::map<std::uint32_t, double> shared;
    for (const int pixel : found[i]) ++shared[cloud.labels[static_cast<std::size_t>(pixel)]];
    if (shared[kNeither] > 0.5 * static_cast<double>(found[i].size())) continue;
    double most = 0;
    for (const auto& [label, count] : shared) {
      if (sizes.count(label) == 0) continue;
      const double overlap = count / (sizes[label] + static_cast<double>(found[i].size()) - count);
      most = std::max(most, overlap);
      best[label] = std::max(best[label], overlap);
      if (count > 0.5 * sizes[label]) covers[label] = i + 1;
    }
    result.detections.push_back({found[i].size(), most >= kRight});
  }
  std::map<std::size_t, int> objects_of;
  for (const auto& [label, i] : covers) ++objects_of[i];
  for (const auto& [label, i] : covers) result.merged += objects_of[i] > 1;
  for (const auto& [label, size] : sizes) {
    ++result.objects;
    result.overlap += best[label];
  }
}

/// Recall and precision if detections with fewer than `fewest` pixels are left out.
struct Point {
  std::size_t fewest = 0;
  double recall = 0, precision = 0;
};

inline std::vector<Point> curveOf(const Result& result) {
  auto detections = result.detections;
  std::sort(detections.begin(), detections.end(),
            [](const Detection& a, const Detection& b) { return a.pixels > b.pixels; });
  std::vector<Point> curve;
  double right = 0;
  for (std::size_t i = 0; i < detections.size(); ++i) {
    right += detections[i].right;
    curve.push_back({detections[i].pixels, right / result.objects, right / static_cast<double>(i + 1)});
  }
  return curve;
}

/// The point with the highest recall among those with at least this precision.
inline Point bestAt(const std::vector<Point>& curve, double precision) {
  Point best;
  for (const Point& point : curve) {
    if (point.precision >= precision && point.recall > best.recall) best = point;
  }
  return best;
}

/// Recall and precision if clusters of fewer than `fewest` points do not count.
inline Point at(const std::vector<Point>& curve, std::size_t fewest) {
  Point last;
  for (const Point& point : curve) {
    if (point.fewest >= fewest) last = point;
  }
  return last;
}

}  // namespace omnimapper::bench
