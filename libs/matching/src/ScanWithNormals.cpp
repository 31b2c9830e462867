#include <omnimapper/matching/ScanWithNormals.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <unordered_set>

namespace omnimapper::matching {

namespace {

// [m] Largest distance between neighbours on one wall, and from a point to the end of its window; noise increases both.
constexpr float kLargestGap = 0.6F, kLongestReach = 2.0F;
constexpr float kGapOfNoise = 4.5F, kReachOfNoise = 10.0F;
// Sizes of windows: number of neighbours on each side.
constexpr std::array<int, 6> kHalfWindows{2, 4, 8, 16, 32, 64};
constexpr int kFewest = 4;
// A line must be known to 8 degrees, both by the scatter of its points and by the noise of the sensor, without which a
// few noisy points behind one another would pass for a wall along the beam; and it must be thinner than a corner.
constexpr double kAngleVariance = 0.14 * 0.14;
constexpr double kThinness = 0.15;  // squared width over squared length

// Cumulative sums over the points, so that the sums of a window are differences of two of them.
class Sums {
 public:
  explicit Sums(const std::vector<Eigen::Vector2f>& points) : sums_(points.size() + 1) {
    Five sum{};
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double x = points[i].x(), y = points[i].y();
      sums_[i] = sum;
      sum[0] += x;
      sum[1] += y;
      sum[2] += x * x;
      sum[3] += x * y;
      sum[4] += y * y;
    }
    sums_[points.size()] = sum;
  }
  using Five = std::array<double, 5>;  // x y xx xy yy
  Five between(int first, int end) const {
    Five difference;
    for (std::size_t k = 0; k < 5; ++k) difference[k] = sums_[end][k] - sums_[first][k];
    return difference;
  }

 private:
  std::vector<Five> sums_;
};

// For each point the first and the last one of its stretch without gaps.
struct Stretches {
  std::vector<int> first, last;
  Stretches(const std::vector<Eigen::Vector2f>& points, float gap) : first(points.size()), last(points.size()) {
    const int count = static_cast<int>(points.size());
    first[0] = 0;
    for (int i = 1; i < count; ++i) {
      first[i] = (points[i] - points[i - 1]).squaredNorm() <= gap * gap ? first[i - 1] : i;
    }
    last[count - 1] = count - 1;
    for (int i = count - 1; i-- > 0;) last[i] = first[i + 1] == i + 1 ? i : last[i + 1];
  }
};

// The line through a window of points, by the eigenvectors of their scatter.
struct WindowLine {
  double mean_x, mean_y;
  double along, across;          // eigenvalues: sums of squares [m2]
  double root, difference, xy_;  // half the difference of the eigenvalues, and its parts

  int count;

  WindowLine(const Sums::Five& sum, int points) : count(points) {
    const double inverse = 1.0 / points;
    mean_x = sum[0] * inverse;
    mean_y = sum[1] * inverse;
    const double xx = sum[2] - sum[0] * mean_x, yy = sum[4] - sum[1] * mean_y;
    xy_ = sum[3] - sum[0] * mean_y;
    difference = 0.5 * (xx - yy);
    root = std::sqrt(difference * difference + xy_ * xy_);
    along = 0.5 * (xx + yy) + root;
    across = std::max(0.0, 0.5 * (xx + yy) - root);
  }
  // Half of the angle whose cosine and sine are difference / root and xy / root is the direction along.
  Eigen::Vector2f normal() const {
    const double cosine = difference / root;
    double c = std::sqrt(0.5 * (1 + std::abs(cosine))), s = 0.5 * xy_ / (root * c);
    if (cosine < 0) std::swap(c, s);
    return {static_cast<float>(-s), static_cast<float>(c)};
  }
};

// Indices of the points that have a neighbour: a beam that ends by itself (a person, glass, a thin leg) must not cut
// the wall behind it in two.
std::vector<int> inCompany(const std::vector<Eigen::Vector2f>& points, float gap) {
  const int count = static_cast<int>(points.size());
  std::vector<int> kept;
  kept.reserve(points.size());
  bool joined = false;  // to the one before
  for (int i = 0; i < count; ++i) {
    const bool joins = i + 1 < count && (points[i + 1] - points[i]).squaredNorm() <= gap * gap;
    if (joined || joins) kept.push_back(i);
    joined = joins;
  }
  return kept;
}

// The smallest window around point i through which a line fits.
std::optional<WindowLine> lineAround(const std::vector<Eigen::Vector2f>& points, const Stretches& stretches,
                                     const Sums& sums, int i, float noise) {
  const float reach = std::max(kLongestReach, kReachOfNoise * noise);
  const auto far = [&](int other) { return (points[other] - points[i]).squaredNorm() > reach * reach; };
  int previous = 0;
  for (const int half : kHalfWindows) {
    int first = std::max(i - half, stretches.first[i]), last = std::min(i + half, stretches.last[i]);
    while (far(first)) ++first;
    while (far(last)) --last;
    const int count = last - first + 1;
    if (count == previous) break;
    previous = count;
    if (count < kFewest) continue;
    const WindowLine line(sums.between(first, last + 1), count);
    const double allowed = kAngleVariance * line.along;
    // Points that coincide have no direction.
    const bool fits = line.root > 0 && line.across <= kThinness * line.along && line.across <= (count - 2) * allowed &&
                      static_cast<double>(noise) * noise <= allowed;
    if (fits) return line;
  }
  return std::nullopt;
}

// Far along a corridor, neighbouring beams end metres apart on the wall. Such points have no neighbour near them, but
// several in a row on one line. Without the normal of the wall they would move with the laser, as the pattern of its
// beams does, and hold a scan back.
constexpr int kSparse = 2;                                  // neighbours on each side that must be on the line
constexpr float kLongestStep = 6;                           // [m] between them
constexpr float kShortestSparse = 2.4F;                     // [m] from the first of them to the last
constexpr float kOffSparse = 0.03F, kOffSparseOfNoise = 3;  // [m] and times the noise: largest distance from the line
constexpr float kPastLaser = 0.3F;  // [m] by which the line must pass the origin: no wall is seen along a beam

std::optional<Eigen::Vector2f> sparseNormal(const std::vector<Eigen::Vector2f>& points, int i, float noise) {
  const int count = static_cast<int>(points.size());
  const int first = std::clamp(i - kSparse, 0, count - 1 - 2 * kSparse), last = first + 2 * kSparse;
  const Eigen::Vector2f span = points[last] - points[first];
  const float length = span.norm();
  if (!(length > kShortestSparse)) return std::nullopt;
  const Eigen::Vector2f along = span / length, normal(-along.y(), along.x());
  if (std::abs(normal.dot(points[i])) < kPastLaser) return std::nullopt;
  const float off = std::max(kOffSparse, kOffSparseOfNoise * noise);
  for (int k = first; k < last; ++k) {
    const float step = along.dot(points[k + 1] - points[k]);
    if (step <= 0 || step > kLongestStep || std::abs(normal.dot(points[k] - points[first])) > off) return std::nullopt;
  }
  return normal;
}

}  // namespace

// From the lower quartile of the second differences: walls are straight enough not to contribute, while corners, edges
// and clutter may be most of all points.
float rangeNoise(const std::vector<Eigen::Vector2f>& points) {
  if (points.size() < 3) return 0;
  constexpr float kQuarter = 0.780F;  // lower quartile for noise of standard deviation 1: 0.3186 sqrt(1 + 4 + 1)
  std::vector<float> squares(points.size() - 2);
  for (std::size_t i = 0; i < squares.size(); ++i) {
    squares[i] = (points[i] - 2 * points[i + 1] + points[i + 2]).squaredNorm();
  }
  const auto quarter = squares.begin() + static_cast<std::ptrdiff_t>(squares.size() / 4);
  std::nth_element(squares.begin(), quarter, squares.end());
  return std::sqrt(*quarter) / kQuarter;
}

ScanWithNormals fitLines(const std::vector<Eigen::Vector2f>& points) {
  ScanWithNormals scan;
  scan.points = points;
  scan.normals.assign(points.size(), Eigen::Vector2f::Zero());
  const float noise = rangeNoise(points);
  const float gap = std::max(kLargestGap, kGapOfNoise * noise);
  const auto kept = inCompany(points, gap);
  if (kept.size() < kFewest) return scan;
  std::vector<Eigen::Vector2f> walls;
  walls.reserve(kept.size());
  for (const int i : kept) walls.push_back(points[i]);
  const Stretches stretches(walls, gap);
  const Sums sums(walls);
  int fitted = 0, taken = 0;
  for (std::size_t j = 0; j < walls.size(); ++j) {
    const auto line = lineAround(walls, stretches, sums, static_cast<int>(j), noise);
    if (!line) continue;
    const Eigen::Vector2f normal = line->normal(), mean(line->mean_x, line->mean_y);
    scan.normals[kept[j]] = normal;
    scan.points[kept[j]] -= normal * normal.dot(walls[j] - mean);
    taken += line->count;
    ++fitted;
  }
  std::vector<bool> is_alone(points.size(), true);
  for (const int i : kept) is_alone[i] = false;
  for (std::size_t i = 0; i < points.size() && points.size() > 2 * kSparse; ++i) {
    if (!is_alone[i]) continue;
    if (const auto normal = sparseNormal(points, static_cast<int>(i), noise)) scan.normals[i] = *normal;
  }
  if (fitted > 0) scan.smoothing = static_cast<float>(taken) / static_cast<float>(fitted);
  return scan;
}

std::vector<bool> withNeighbours(std::vector<bool> marked, const ScanWithNormals& scan) {
  const int count = static_cast<int>(marked.size()), window = kHalfWindows[1];
  const auto given = marked;
  const auto spread = [&](int from, int step) {
    for (int k = 0, i = from; k < window; ++k, i += step) {
      const int next = i + step;
      if (next < 0 || next >= count || given[next]) return;
      if ((scan.points[next] - scan.points[i]).squaredNorm() > kLargestGap * kLargestGap) return;
      marked[next] = true;
    }
  };
  for (int i = 0; i < count; ++i) {
    if (!given[i]) continue;
    spread(i, 1);
    spread(i, -1);
  }
  return marked;
}

ScanWithNormals without(const std::vector<bool>& dropped, const ScanWithNormals& scan) {
  ScanWithNormals kept;
  kept.smoothing = scan.smoothing;
  for (std::size_t i = 0; i < scan.size(); ++i) {
    if (dropped[i]) continue;
    kept.points.push_back(scan.points[i]);
    kept.normals.push_back(scan.normals[i]);
    if (!scan.things.empty()) kept.things.push_back(scan.things[i]);
    if (!scan.weights.empty()) kept.weights.push_back(scan.weights[i]);
  }
  return kept;
}

void append(const ScanWithNormals& scan, const mrpt::math::TPose2D& target_from_scan, ScanWithNormals& target) {
  const auto c = static_cast<float>(std::cos(target_from_scan.phi)),
             s = static_cast<float>(std::sin(target_from_scan.phi));
  const auto tx = static_cast<float>(target_from_scan.x), ty = static_cast<float>(target_from_scan.y);
  for (std::size_t i = 0; i < scan.size(); ++i) {
    const auto& p = scan.points[i];
    const auto& n = scan.normals[i];
    target.points.emplace_back(tx + c * p.x() - s * p.y(), ty + s * p.x() + c * p.y());
    target.normals.emplace_back(c * n.x() - s * n.y(), s * n.x() + c * n.y());
  }
}

ScanWithNormals voxelDownsample(const ScanWithNormals& scan, double side) {
  std::unordered_set<std::uint64_t> taken;
  ScanWithNormals kept;
  for (std::size_t i = 0; i < scan.size(); ++i) {
    const auto& p = scan.points[i];
    const auto column = static_cast<std::int32_t>(std::floor(p.x() / side)),
               row = static_cast<std::int32_t>(std::floor(p.y() / side));
    const std::uint64_t cell =
        (std::uint64_t{static_cast<std::uint32_t>(column)} << 32) | static_cast<std::uint32_t>(row);
    if (!taken.insert(cell).second) continue;
    kept.points.push_back(p);
    kept.normals.push_back(scan.normals[i]);
  }
  return kept;
}

}  // namespace omnimapper::matching
