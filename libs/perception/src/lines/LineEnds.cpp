#include "LineEnds.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace omnimapper::perception::lines {

namespace {

constexpr int kReach = 12;          // points on either side of a seam that may go to the other line
constexpr double kParallel = 0.1;   // sine of the angle between two lines; below it their crossing is undetermined
constexpr double kSteepest = 4;     // range over arc: a surface up to 75 degrees oblique to the beams is no occlusion
constexpr double kSameDepth = 0.1;  // [m] smaller steps in depth, as of frames and skirtings, belong to the wall

std::optional<Eigen::Vector2d> crossing(const Line& a, const Line& b) {
  const double sine = a.nx * b.ny - a.ny * b.nx;
  if (std::abs(sine) < kParallel) return std::nullopt;
  return Eigen::Vector2d((a.distance * b.ny - b.distance * a.ny) / sine,
                         (b.distance * a.nx - a.distance * b.nx) / sine);
}

Eigen::Vector2d footOf(const ScanPoints& points, int i, const Line& line) {
  const double off = points.offset(i, line);
  return {points.x[i] - off * line.nx, points.y[i] - off * line.ny};
}

// Distance [m] along a line between neighbouring beams at point i.
double spacing(const ScanPoints& points, int i, const Line& line) {
  const double facing = std::abs(line.nx * points.ux[i] + line.ny * points.uy[i]);
  return points.range[i] * points.step / std::max(facing, 0.05);
}

// Why a line ends, from what follows its last point (direction = 1) or precedes its first one (direction = -1).
obs::LineEnd reason(const ScanPoints& points, int end, int direction, double gate) {
  int next = end + direction;
  const int size = points.size();
  if (points.all_round) next = (next + size) % size;
  if (next < 0 || next >= size) return obs::LineEnd::view;
  int beams = std::abs(points.beam[next] - points.beam[end]);
  if (points.all_round) beams = std::min(beams, points.beams - beams);
  if (beams > 2) return obs::LineEnd::view;  // one beam may fail
  const double nearer = points.range[end] - points.range[next];
  const double noise = gate * std::sqrt(2 * (points.steep[end] + points.across[end]));
  const double slope = kSteepest * points.step * beams * points.range[next];
  return nearer > std::max({noise, slope, kSameDepth}) ? obs::LineEnd::occluded : obs::LineEnd::wall;
}

// The corner of two neighbouring lines; none if either of them ends farther from it than 1.5 beam spacings and the
// noise.
std::optional<Eigen::Vector2d> cornerWith(const ScanPoints& points, const Fit& fit, int end, const Fit& neighbour,
                                          int neighbours_end, double gate) {
  const auto corner = crossing(fit.line, neighbour.line);
  if (!corner) return std::nullopt;
  const auto reaches = [&](const Fit& which, int i) {
    const double noise = gate * std::sqrt(points.steep[i] + points.across[i]);
    return (footOf(points, i, which.line) - *corner).norm() <= 1.5 * spacing(points, i, which.line) + noise;
  };
  return reaches(fit, end) && reaches(neighbour, neighbours_end) ? corner : std::nullopt;
}

}  // namespace

void shareOut(const ScanPoints& points, std::vector<Stretch>& stretches, double gate) {
  const double limit = gate * gate;
  for (std::size_t k = 1; k < stretches.size(); ++k) {
    Stretch &a = stretches[k - 1], &b = stretches[k];
    // Parallel walls keep their points: points between them fit both, so their costs determine no seam.
    const bool is_parallel = std::abs(a.line.nx * b.line.ny - a.line.ny * b.line.nx) < kParallel;
    if (b.first > a.last + 3 || b.last <= a.last || is_parallel) continue;
    const int from = std::max(a.first + 1, std::min(a.last, b.first) - kReach);
    const int to = std::min(b.last - 1, std::max(a.last, b.first) + kReach);
    const auto cost = [&](int i, const Line& line) { return std::min(limit, points.chiSquare(i, line)); };
    double sum = 0;  // cost with the seam at `from`: all points are of b
    for (int i = from; i <= to; ++i) sum += cost(i, b.line);
    double least = sum;
    int seam = from;  // first point of b
    for (int i = from; i <= to; ++i) {
      sum += cost(i, a.line) - cost(i, b.line);
      if (sum < least) {
        least = sum;
        seam = i + 1;
      }
    }
    a.last = seam - 1;
    b.first = seam;
  }
}

Ends endsOf(const ScanPoints& points, const std::vector<Fit>& fits, std::size_t index, double gate) {
  const Fit& fit = fits[index];
  Ends ends{{footOf(points, fit.first, fit.line), footOf(points, fit.last, fit.line)},
            reason(points, fit.first, -1, gate),
            reason(points, fit.last, 1, gate)};
  const auto at = [&](std::size_t i) { return &fits[(i + fits.size()) % fits.size()]; };
  const Fit* before = index > 0 || points.all_round ? at(index + fits.size() - 1) : nullptr;
  const Fit* after = index + 1 < fits.size() || points.all_round ? at(index + 1) : nullptr;
  if (before == &fit) before = after = nullptr;
  if (before) {
    if (const auto corner = cornerWith(points, fit, fit.first, *before, before->last, gate)) {
      ends.segment.from = *corner;
      ends.from = obs::LineEnd::wall;
    }
  }
  if (after) {
    if (const auto corner = cornerWith(points, fit, fit.last, *after, after->first, gate)) {
      ends.segment.to = *corner;
      ends.to = obs::LineEnd::wall;
    }
  }
  return ends;
}

}  // namespace omnimapper::perception::lines
