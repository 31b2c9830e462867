#pragma once

#include <omnimapper/perception/ConnectedComponents.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "DepthRooms.h"

namespace omnimapper::perception::rooms {

/// Agreement of segments with the truth. The last five counts are those of SegComp: A. Hoover et al., An
/// experimental comparison of range image segmentation algorithms, PAMI 18(7), 1996, at a tolerance of 80 %. Counts of
/// several images add up.
struct Agreement {
  int true_planes = 0;  ///< connected parts of faces with enough pixels
  int found = 0;        ///< true planes with a segment at an intersection over union of at least 0.8
  int reported = 0;     ///< segments
  int reported_right = 0;
  double true_pixels = 0;   ///< of true planes
  double pixels_right = 0;  ///< true pixels in the segment that covers their plane best

  int correct = 0;  ///< true planes of which a segment holds 80 %, and that are 80 % of it
  int over = 0;     ///< true planes that fall into two or more segments
  int under = 0;    ///< segments that cover two or more true planes
  int missed = 0;   ///< true planes that take part in none of these
  int noise = 0;    ///< segments that take part in none of these

  double pixelsRight() const { return pixels_right / std::max(1.0, true_pixels); }
  Agreement& operator+=(const Agreement& other) {
    true_planes += other.true_planes, found += other.found;
    reported += other.reported, reported_right += other.reported_right;
    true_pixels += other.true_pixels, pixels_right += other.pixels_right;
    correct += other.correct, over += other.over, under += other.under;
    missed += other.missed, noise += other.noise;
    return *this;
  }
};

/// How many pixels each true plane shares with each segment.
class Overlaps {
 public:
  /// Labels from 1 on are segments. True planes with fewer pixels than `fewest` do not count, and their pixels belong
  /// to no true plane.
  Overlaps(const View& truth, const std::vector<std::uint16_t>& labels, int width, int height, int fewest) {
    const Components components = connectComponents(width, height, SameFace{truth.face.data()});
    std::vector<int> index_of(components.pixels.size(), -1);
    for (std::size_t i = 0; i < components.pixels.size(); ++i) {
      if (components.pixels[i] < fewest) continue;
      index_of[i] = static_cast<int>(planes.size());
      planes.push_back(components.pixels[i]);
    }
    segments.resize(labels.empty() ? 0 : *std::max_element(labels.begin(), labels.end()), 0);
    shared_.resize(planes.size() * segments.size(), 0);
    const std::vector<std::int32_t> patch = components.labels();
    for (std::size_t i = 0; i < labels.size(); ++i) {
      if (labels[i] == 0) continue;
      ++segments[labels[i] - 1U];
      const int plane = patch[i] == 0 ? -1 : index_of[static_cast<std::size_t>(patch[i] - 1)];
      if (plane >= 0) ++shared_[static_cast<std::size_t>(plane) * segments.size() + labels[i] - 1U];
    }
  }

  int shared(std::size_t plane, std::size_t segment) const { return shared_[plane * segments.size() + segment]; }

  std::vector<int> planes, segments;  ///< [px] of each

 private:
  struct SameFace {
    const std::uint16_t* faces;
    bool valid(int pixel) const { return faces[pixel] != 0; }
    bool similar(int a, int b) const { return faces[a] == faces[b]; }
  };
  std::vector<int> shared_;
};

inline void countPixels(const Overlaps& overlaps, Agreement& result) {
  for (std::size_t p = 0; p < overlaps.planes.size(); ++p) {
    result.true_pixels += overlaps.planes[p];
    std::size_t best = 0;
    for (std::size_t s = 1; s < overlaps.segments.size(); ++s) {
      if (overlaps.shared(p, s) > overlaps.shared(p, best)) best = s;
    }
    if (overlaps.segments.empty()) continue;
    // A segment over two planes counts as right on the plane of which it covers more.
    bool most = true;
    for (std::size_t other = 0; other < overlaps.planes.size(); ++other) {
      most &= overlaps.shared(other, best) <= overlaps.shared(p, best);
    }
    if (most) result.pixels_right += overlaps.shared(p, best);
  }
}

inline void countFound(const Overlaps& overlaps, Agreement& result) {
  for (std::size_t s = 0; s < overlaps.segments.size(); ++s) {
    if (overlaps.segments[s] == 0) continue;
    ++result.reported;
    for (std::size_t p = 0; p < overlaps.planes.size(); ++p) {
      const double shared = overlaps.shared(p, s);
      if (shared < 0.8 * (overlaps.planes[p] + overlaps.segments[s] - shared)) continue;
      ++result.found;
      ++result.reported_right;
    }
  }
  result.true_planes += static_cast<int>(overlaps.planes.size());
}

inline void countSegComp(const Overlaps& overlaps, Agreement& result) {
  constexpr double kTolerance = 0.8;
  std::vector<bool> explained_plane(overlaps.planes.size(), false), explained(overlaps.segments.size(), false);
  for (std::size_t p = 0; p < overlaps.planes.size(); ++p) {
    std::vector<std::size_t> parts;
    int sum = 0;
    for (std::size_t s = 0; s < overlaps.segments.size(); ++s) {
      const int shared = overlaps.shared(p, s);
      if (shared == 0 || shared < kTolerance * overlaps.segments[s]) continue;
      parts.push_back(s);
      sum += shared;
      if (shared < kTolerance * overlaps.planes[p]) continue;
      ++result.correct;
      explained_plane[p] = explained[s] = true;
    }
    if (explained_plane[p] || parts.size() < 2 || sum < kTolerance * overlaps.planes[p]) continue;
    ++result.over;
    explained_plane[p] = true;
    for (const std::size_t s : parts) explained[s] = true;
  }
  for (std::size_t s = 0; s < overlaps.segments.size(); ++s) {
    std::vector<std::size_t> parts;
    int sum = 0;
    for (std::size_t p = 0; p < overlaps.planes.size(); ++p) {
      const int shared = overlaps.shared(p, s);
      if (shared == 0 || shared < kTolerance * overlaps.planes[p]) continue;
      parts.push_back(p);
      sum += shared;
    }
    if (explained[s] || parts.size() < 2 || sum < kTolerance * overlaps.segments[s]) continue;
    ++result.under;
    explained[s] = true;
    for (const std::size_t p : parts) explained_plane[p] = true;
  }
  result.missed += static_cast<int>(std::count(explained_plane.begin(), explained_plane.end(), false));
  for (std::size_t s = 0; s < overlaps.segments.size(); ++s) result.noise += overlaps.segments[s] > 0 && !explained[s];
}

/// True planes with at least `fewest` pixels count.
inline Agreement compare(const View& truth, const std::vector<std::uint16_t>& labels, int width, int height,
                         int fewest) {
  const Overlaps overlaps(truth, labels, width, height, fewest);
  Agreement result;
  countFound(overlaps, result);
  countPixels(overlaps, result);
  countSegComp(overlaps, result);
  return result;
}

}  // namespace omnimapper::perception::rooms
