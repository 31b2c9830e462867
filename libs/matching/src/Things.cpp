#include <omnimapper/matching/Things.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace omnimapper::matching {

namespace {

// doc/results/robustness.md has the logs on which these were chosen.
constexpr float kThingGap = 0.2F;            // [m] between neighbours on one thing, at the laser
constexpr float kThingGapPerRange = 0.03F;   // the same for each metre of range
constexpr float kLargestThing = 1.0F;        // [m] extent of a thing that stands before everything beside it
constexpr float kLargestHiddenThing = 0.6F;  // [m] extent of a thing that something nearer hides on one side
constexpr std::size_t kFewestOfThing = 4;    // points; fewer may be beams on a wall
constexpr float kTooNoisy = 0.08F;           // [m] noise of a laser that breaks walls into pieces
constexpr float kOffSparseWall = 0.06F;      // [m] of a beam from the line of a wall that is seen along its length

float rangeFrom(const Eigen::Vector2f& point, const Eigen::Vector2f& sensor) {
  return (point - sensor).norm();
}

using BeamPoints = std::vector<Eigen::Vector2f>;

struct ScanPiece {
  std::size_t begin, end;
};

std::vector<ScanPiece> piecesOf(const BeamPoints& points, const Eigen::Vector2f& sensor) {
  std::vector<ScanPiece> pieces;
  std::size_t begin = 0;
  for (std::size_t i = 1; i <= points.size(); ++i) {
    if (i < points.size()) {
      const auto &a = points[i - 1], &b = points[i];
      const float gap = kThingGap + kThingGapPerRange * std::min(rangeFrom(a, sensor), rangeFrom(b, sensor));
      if ((a - b).squaredNorm() <= gap * gap) continue;
    }
    pieces.push_back({begin, i});
    begin = i;
  }
  return pieces;
}

float extentOf(const BeamPoints& points, const ScanPiece& piece) {
  Eigen::Array2f low = points[piece.begin], high = low;
  for (std::size_t i = piece.begin; i < piece.end; ++i) {
    low = low.min(points[i].array());
    high = high.max(points[i].array());
  }
  return (high - low).matrix().norm();
}

// Far along a wall, the beams end so far apart that each is a piece by itself. It lies on a line with the points beside
// it, of which one is nearer and one is farther.
bool isOfSparseWall(const BeamPoints& points, const ScanPiece& piece) {
  if (piece.end - piece.begin >= kFewestOfThing || points.size() < 3) return false;
  const std::size_t first = piece.begin == 0 ? piece.end : piece.begin - 1;
  std::size_t second = piece.end;
  if (piece.begin == 0) second = piece.end + 1;
  if (piece.end == points.size()) second = piece.begin - 2;
  if (first >= points.size() || second >= points.size()) return false;
  const Eigen::Vector2f along = points[second] - points[first], off = points[piece.begin] - points[first];
  return std::abs(along.x() * off.y() - along.y() * off.x()) < kOffSparseWall * along.norm();
}

bool isThing(const BeamPoints& points, const ScanPiece& piece, const Eigen::Vector2f& sensor) {
  const auto range = [&](std::size_t i) { return rangeFrom(points[i], sensor); };
  const bool hidden_before = piece.begin > 0 && range(piece.begin - 1) < range(piece.begin);
  const bool hidden_after = piece.end < points.size() && range(piece.end) < range(piece.end - 1);
  if (hidden_before && hidden_after) return false;  // the piece of a wall that is seen between two things
  const bool is_between = hidden_before != hidden_after;
  return extentOf(points, piece) < (is_between ? kLargestHiddenThing : kLargestThing) &&
         !(is_between && isOfSparseWall(points, piece));
}

}  // namespace

std::vector<int> numberThings(const BeamPoints& points, const Eigen::Vector2f& sensor, float noise) {
  std::vector<int> things(points.size(), ScanWithNormals::kNoThing);
  if (noise > kTooNoisy) return things;
  int number = 0;
  for (const auto& piece : piecesOf(points, sensor)) {
    if (piece.end == piece.begin || !isThing(points, piece, sensor)) continue;
    std::fill(things.begin() + static_cast<std::ptrdiff_t>(piece.begin),
              things.begin() + static_cast<std::ptrdiff_t>(piece.end), number);
    ++number;
  }
  return things;
}

}  // namespace omnimapper::matching
