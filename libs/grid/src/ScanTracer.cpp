#include <omnimapper/geometry/Angle.h>
#include <omnimapper/grid/ScanBeams.h>
#include <omnimapper/grid/ScanTracer.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace omnimapper::grid {

namespace {

/// Neighbouring beams end on one surface if the line between their ends is seen at more than this angle.
constexpr double kGrazing = 3 * geometry::kPi / 180;
/// They surely do if the line is seen at more than this angle and is no longer than this [m].
constexpr double kFacing = 20 * geometry::kPi / 180, kSureGap = 0.3;

/// Square of the sine of the angle at which the line from a to b is seen from the origin, at its further end.
template <class End>
double squaredSineOfView(const End& a, const End& b, const End& origin) {
  const double ax = a.x - origin.x, ay = a.y - origin.y, bx = b.x - origin.x, by = b.y - origin.y;
  const double cross = ax * by - ay * bx, further = std::max(ax * ax + ay * ay, bx * bx + by * by);
  const double gap = (bx - ax) * (bx - ax) + (by - ay) * (by - ay);
  return gap > 0 ? cross * cross / (further * gap) : 0;
}

double squaredSine(double angle) {
  return std::sin(angle) * std::sin(angle);
}

}  // namespace

void ScanTracer::place(const mrpt::obs::CObservation2DRangeScan& scan, const mrpt::poses::CPose3D& map_from_sensor,
                       double resolution) {
  const BeamEnds ends(scan, map_from_sensor, BeamEnds::Pose::of_sensor);
  const double range = std::min<double>(max_range_, scan.maxRange), scale = 1 / resolution;
  origin_.x = map_from_sensor.x() * scale, origin_.y = map_from_sensor.y() * scale;
  double min_x = origin_.x, max_x = min_x, min_y = origin_.y, max_y = min_y;
  beams_.resize(ends.size());
  for (std::size_t i = 0; i < beams_.size(); ++i) {
    Beam& beam = beams_[i];
    beam.is_valid = ends.clears(i);
    beam.hits = ends.hits(i) && ends.range(i) < range;
    if (!beam.is_valid) continue;
    const auto end = ends.at(i, range);
    beam.x = end.x * scale, beam.y = end.y * scale;
    min_x = std::min(min_x, beam.x), max_x = std::max(max_x, beam.x);
    min_y = std::min(min_y, beam.y), max_y = std::max(max_y, beam.y);
  }
  // One more cell at each side, because lines are rounded.
  const auto cell = [](double at) { return static_cast<std::int64_t>(std::floor(at)); };
  votes_.moveTo({cell(min_x) - 1, cell(min_y) - 1, cell(max_x) + 1, cell(max_y) + 1});
  const auto left = static_cast<double>(votes_.minX());
  const auto low = static_cast<double>(votes_.minY());
  origin_.x -= left, origin_.y -= low;
  for (Beam& beam : beams_) beam.x -= left, beam.y -= low;
}

void ScanTracer::voteSurfaces(double resolution) {
  static const double grazing = squaredSine(kGrazing), facing = squaredSine(kFacing);
  const double sure_gap = kSureGap / resolution;
  for (std::size_t i = 1; i < beams_.size(); ++i) {
    const Beam &a = beams_[i - 1], &b = beams_[i];
    if (!a.hits || !b.hits) continue;
    const double view = squaredSineOfView(a, b, origin_);
    if (view < grazing) continue;
    const bool is_sure = view > facing && std::hypot(b.x - a.x, b.y - a.y) <= sure_gap;
    votes_.voteLine(a.x, a.y, b.x, b.y, is_sure ? kSurfaceVote : 0);
  }
}

VoteWindow& ScanTracer::trace(const mrpt::obs::CObservation2DRangeScan& scan,
                              const mrpt::poses::CPose3D& map_from_sensor, double resolution) {
  place(scan, map_from_sensor, resolution);
  votes_.voteCell(origin_.x, origin_.y, kPassVote);  // where the sensor is, nothing else is
  for (const Beam& beam : beams_) {
    if (beam.is_valid) votes_.voteLine(origin_.x, origin_.y, beam.x, beam.y, kPassVote);
  }
  voteSurfaces(resolution);
  for (const Beam& beam : beams_) {
    if (beam.hits) votes_.voteCell(beam.x, beam.y, kHitVote);
  }
  return votes_;
}

}  // namespace omnimapper::grid
