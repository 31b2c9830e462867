#include <omnimapper/base/SplitMix.h>

#include <algorithm>
#include <cstdint>

#include "LineFinder.h"
#include "LineFit.h"

namespace omnimapper::perception::lines {

namespace {

class Ransac : public LineFinder {
 public:
  explicit Ransac(const LaserLineOptions& options) : options_(options), limit_(options.gate * options.gate) {}

  std::vector<Stretch> find(const ScanPoints& points) const override {
    base::SplitMix random(static_cast<std::uint64_t>(options_.seed));
    std::vector<int> left(points.x.size());
    for (std::size_t i = 0; i < left.size(); ++i) left[i] = static_cast<int>(i);
    std::vector<Stretch> found;
    while (static_cast<int>(left.size()) >= options_.min_points) {
      const auto inliers = largestSet(points, left, random);
      const auto stretches = withoutGaps(points, inliers);
      const std::size_t before = left.size();
      for (const Stretch& stretch : stretches) {
        found.push_back(stretch);
        const auto is_on = [&](int i) {
          return i >= stretch.first && i <= stretch.last && points.chiSquare(i, stretch.line) <= limit_;
        };
        left.erase(std::remove_if(left.begin(), left.end(), is_on), left.end());
      }
      // Stop if no point was removed: no line was found, or the lines miss the points that they were fitted to.
      if (left.size() == before) break;
    }
    std::sort(found.begin(), found.end(), [](const Stretch& a, const Stretch& b) { return a.first < b.first; });
    return found;
  }

 private:
  struct Inliers {
    Line line;
    std::vector<int> points;
  };

  int countOn(const ScanPoints& points, const std::vector<int>& left, const Line& line) const {
    int count = 0;
    for (const int i : left) {
      const double off = points.offset(i, line);
      count += off * off <= limit_ * points.variance(i, line);
    }
    return count;
  }

  Inliers on(const ScanPoints& points, const std::vector<int>& left, const Line& line) const {
    Inliers inliers{line, {}};
    for (const int i : left) {
      if (points.chiSquare(i, line) <= limit_) inliers.points.push_back(i);
    }
    return inliers;
  }

  Inliers largestSet(const ScanPoints& points, const std::vector<int>& left, base::SplitMix& random) const {
    const int size = static_cast<int>(left.size());
    // The second point is drawn near the first one in the scan, where it is more often on the same wall.
    const int window = std::max(4, size / 4);
    int most = 0;
    Line best;
    for (int trial = 0; trial < options_.ransac_trials; ++trial) {
      const int a = random.below(size), b = (a + 1 + random.below(std::min(window, size - 1))) % size;
      const Line line = throughPoints(points, left[static_cast<std::size_t>(a)], left[static_cast<std::size_t>(b)]);
      const int count = countOn(points, left, line);
      if (count > most) {
        most = count;
        best = line;
      }
    }
    Inliers inliers = on(points, left, best);
    for (int round = 0; round < 2 && inliers.points.size() >= 2; ++round) {
      inliers = on(points, left, lineOf(points, inliers.points, 0, inliers.points.size()));
    }
    return inliers;
  }

  static Line lineOf(const ScanPoints& points, const std::vector<int>& of, std::size_t begin, std::size_t end) {
    Moments moments;
    for (std::size_t k = begin; k < end; ++k) moments.add(points.x[of[k]], points.y[of[k]]);
    return moments.line();
  }

  // Splits the inliers into one line for each side of a gap, and drops lines with too few points.
  std::vector<Stretch> withoutGaps(const ScanPoints& points, const Inliers& inliers) const {
    std::vector<Stretch> stretches;
    const auto& of = inliers.points;
    for (std::size_t begin = 0, k = 1; k <= of.size(); ++k) {
      if (k < of.size() && !points.isGap(of[k - 1], of[k], options_.max_gap)) continue;
      if (static_cast<int>(k - begin) >= options_.min_points)
        stretches.push_back({of[begin], of[k - 1], lineOf(points, of, begin, k)});
      begin = k;
    }
    return stretches;
  }

  LaserLineOptions options_;
  double limit_;
};

}  // namespace

std::unique_ptr<LineFinder> makeRansac(const LaserLineOptions& options) {
  return std::make_unique<Ransac>(options);
}

}  // namespace omnimapper::perception::lines
