#include <algorithm>
#include <cmath>
#include <optional>

#include "LineFinder.h"
#include "LineFit.h"

namespace omnimapper::perception::lines {

namespace {

constexpr int kFewest = 3;     // points of a piece that may be part of a line
constexpr int kLookAhead = 3;  // pieces that a line may be merged with: an object before a wall is one or two pieces

class SplitAndMerge : public LineFinder {
 public:
  explicit SplitAndMerge(const LaserLineOptions& options)
      : max_gap_(options.max_gap), limit_(options.gate * options.gate), fewest_(options.min_points) {}

  std::vector<Stretch> find(const ScanPoints& points) const override {
    const auto sums = sumsOf(points);
    auto pieces = split(points, sums);
    mergeAll(points, pieces);
    // Small pieces of objects before a wall would keep the wall's parts from being merged.
    const auto is_small = [&](const Stretch& piece) { return piece.last - piece.first + 1 < fewest_; };
    pieces.erase(std::remove_if(pieces.begin(), pieces.end(), is_small), pieces.end());
    grow(points, pieces);
    mergeAll(points, pieces);
    return pieces;
  }

 private:
  // Moments of the points before each point.
  static std::vector<Moments> sumsOf(const ScanPoints& points) {
    std::vector<Moments> sums(1);
    sums.reserve(points.x.size() + 1);
    for (int i = 0; i < points.size(); ++i) {
      sums.push_back(sums.back());
      sums.back().add(points.x[i], points.y[i]);
    }
    return sums;
  }

  // Splits points that deviate from their line by more than the noise at the point farthest from their chord, until
  // each piece is on a line.
  std::vector<Stretch> split(const ScanPoints& points, const std::vector<Moments>& sums) const {
    std::vector<Stretch> pieces;
    std::vector<std::pair<int, int>> waiting;  // the first points are on top
    for (int j = points.size() - 1, i = j; i >= 0; --i) {
      if (i > 0 && !points.isGap(i - 1, i, max_gap_)) continue;
      waiting.emplace_back(i, j);
      j = i - 1;
    }
    while (!waiting.empty()) {
      const auto [i, j] = waiting.back();
      waiting.pop_back();
      if (j - i + 1 < kFewest) continue;
      const Line line = sums[j + 1].minus(sums[i]).line();
      if (isOnLine(points, i, j, line)) {
        pieces.push_back({i, j, line});
        continue;
      }
      const int corner = farthest(points, i, j);
      waiting.emplace_back(corner + 1, j);
      waiting.emplace_back(i, corner);
    }
    return pieces;
  }

  bool isOnLine(const ScanPoints& points, int i, int j, const Line& line) const {
    for (int k = i; k <= j; ++k) {
      const double off = points.offset(k, line);
      if (off * off > limit_ * points.variance(k, line)) return false;
    }
    return true;
  }

  // The point farthest from the chord, from i to j - 1, so that both parts are smaller than the whole.
  static int farthest(const ScanPoints& points, int i, int j) {
    const Line chord = throughPoints(points, i, j);
    int corner = (i + j) / 2;
    double most = 0;
    for (int k = i + 1; k < j; ++k) {
      const double off = std::abs(points.offset(k, chord));
      if (off > most) {
        most = off;
        corner = k;
      }
    }
    return corner;
  }

  void mergeAll(const ScanPoints& points, std::vector<Stretch>& pieces) const {
    while (merge(points, pieces)) {
    }
  }

  // Extends each line by the points on it beyond its ends, up to the next line or gap.
  void grow(const ScanPoints& points, std::vector<Stretch>& pieces) const {
    for (std::size_t k = 0; k < pieces.size(); ++k) {
      Stretch& piece = pieces[k];
      const int low = k > 0 ? pieces[k - 1].last + 1 : 0;
      const int high = k + 1 < pieces.size() ? pieces[k + 1].first - 1 : points.size() - 1;
      for (int i = piece.last + 1; i <= high && !points.isGap(piece.last, i, max_gap_); ++i) {
        if (points.chiSquare(i, piece.line) <= limit_) piece.last = i;
      }
      for (int i = piece.first - 1; i >= low && !points.isGap(i, piece.first, max_gap_); --i) {
        if (points.chiSquare(i, piece.line) <= limit_) piece.first = i;
      }
    }
  }

  // Makes one pass over the pieces and returns whether any were merged.
  bool merge(const ScanPoints& points, std::vector<Stretch>& pieces) const {
    bool merged = false;
    std::vector<bool> taken(pieces.size(), false);
    std::vector<Stretch> result;
    for (std::size_t a = 0; a < pieces.size(); ++a) {
      if (taken[a]) continue;
      Stretch whole = pieces[a];
      int tried = 0;
      for (std::size_t b = a + 1; b < pieces.size() && tried < kLookAhead; ++b) {
        if (taken[b]) continue;
        ++tried;
        if (points.isGap(whole.last, pieces[b].first, max_gap_)) break;
        if (const auto line = common(points, whole, pieces[b])) {
          whole = {whole.first, pieces[b].last, *line};
          taken[b] = merged = true;
          tried = 0;
        }
      }
      result.push_back(whole);
    }
    pieces = std::move(result);
    return merged;
  }

  // The common line of two pieces; none if more than one in eight inliers of either piece is not on it.
  std::optional<Line> common(const ScanPoints& points, const Stretch& a, const Stretch& b) const {
    Moments moments;
    for (const Stretch* part : {&a, &b}) {
      for (int i = part->first; i <= part->last; ++i) {
        if (points.chiSquare(i, part->line) <= limit_) moments.add(points.x[i], points.y[i]);
      }
    }
    const Line line = moments.line();
    for (const Stretch* part : {&a, &b}) {
      int on_part = 0, off = 0;
      for (int i = part->first; i <= part->last; ++i) {
        if (points.chiSquare(i, part->line) > limit_) continue;
        ++on_part;
        off += points.chiSquare(i, line) > limit_;
      }
      if (8 * off > on_part) return std::nullopt;
    }
    return line;
  }

  double max_gap_, limit_;
  int fewest_;
};

}  // namespace

std::unique_ptr<LineFinder> makeSplitAndMerge(const LaserLineOptions& options) {
  return std::make_unique<SplitAndMerge>(options);
}

}  // namespace omnimapper::perception::lines
