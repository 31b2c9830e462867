#include <omnimapper/geometry/Angle.h>
#include <omnimapper/perception/LaserLineExtractor.h>

#include <algorithm>
#include <cmath>

#include "lines/LineEnds.h"
#include "lines/LineFinder.h"
#include "lines/LineFit.h"
#include "lines/ScanPoints.h"

namespace omnimapper::perception {

const base::OptionTable<LaserLineOptions>& LaserLineOptions::table() {
  using Options = LaserLineOptions;
  using base::Range;
  static const auto table =
      base::OptionTable<Options>()
          .choice<Method>("method", &Options::method,
                          {{"split_and_merge", Method::split_and_merge}, {"ransac", Method::ransac}},
                          "Algorithm that finds the scan points on one line.")
          .number("min_range_m", &Options::min_range, Range::notNegative(), "Readings nearer than this are dropped.")
          .number("max_range_m", &Options::max_range, Range::positive(), "Readings farther than this are dropped.")
          .number("range_sigma_m", &Options::range_sigma, Range::positive(), "Standard deviation of a range reading.")
          .number("beam_width_deg", &Options::beam_width, {0, 10},
                  "Full opening angle of a beam. A beam that meets a wall obliquely covers a part of the wall over "
                  "which the range varies; this variation is added to the noise.")
          .number("roughness_m", &Options::roughness, Range::notNegative(),
                  "Standard deviation by which a wall's surface deviates from a flat one.")
          .number("gate_sigmas", &Options::gate, Range::positive(),
                  "A point that is farther from a line than this many standard deviations does not belong to the line.")
          .number("max_gap_m", &Options::max_gap, Range::notNegative(),
                  "A line is split between two of its points that are farther apart than this if the beams between "
                  "them did not meet the line.")
          .number("min_length_m", &Options::min_length, Range::positive(), "Lines shorter than this are dropped.")
          .integer("min_points", &Options::min_points, {3, 100000}, "Lines with fewer points are dropped.")
          .integer("ransac_trials", &Options::ransac_trials, {1, 100000},
                   "Number of point pairs that RANSAC draws for each line.")
          .integer("seed", &Options::seed, {0, 2147483647},
                   "Seed of the random numbers by which RANSAC draws point pairs.");
  return table;
}

namespace {

using namespace lines;

// In a scan all round, a wall may continue across the start of the scan. It is found in one piece if the points are
// made to start at another wall.
ScanPoints findLines(ScanPoints points, const LineFinder& finder, std::vector<Stretch>& stretches) {
  stretches = finder.find(points);
  if (!points.all_round || stretches.size() < 2) return points;
  if (stretches.front().first > 2 || stretches.back().last < points.size() - 3) return points;
  points = startingAt(std::move(points), stretches[1].first);
  stretches = finder.find(points);
  return points;
}

double lengthOf(const ScanPoints& points, const Fit& fit) {
  return points.distanceBetween(fit.first, fit.last);
}

// Splits stretches where the points on their lines leave gaps.
std::vector<Stretch> splitAtGaps(const ScanPoints& points, const std::vector<Stretch>& stretches,
                                 const LaserLineOptions& options) {
  std::vector<Stretch> parts;
  for (const auto& stretch : stretches) {
    int first = -1, last = -1;
    for (int i = stretch.first; i <= stretch.last; ++i) {
      if (points.chiSquare(i, stretch.line) > options.gate * options.gate) continue;
      if (last >= 0 && (points.isGap(last, i, options.max_gap) || points.isBehind(last, i, options.max_gap))) {
        parts.push_back({first, last, stretch.line});
        first = -1;
      }
      if (first < 0) first = i;
      last = i;
    }
    if (first >= 0) parts.push_back({first, last, stretch.line});
  }
  return parts;
}

std::vector<Fit> fitsOf(const ScanPoints& points, std::vector<Stretch> stretches, const LaserLineOptions& options) {
  // Stretches that are too small for a line are removed first, so that they do not affect where their neighbours end.
  const auto tooSmall = [&](const Stretch& stretch) {
    return stretch.last - stretch.first + 1 < options.min_points ||
           points.distanceBetween(stretch.first, stretch.last) < 0.5 * options.min_length;
  };
  stretches.erase(std::remove_if(stretches.begin(), stretches.end(), tooSmall), stretches.end());
  shareOut(points, stretches, options.gate);
  for (auto& stretch : stretches) stretch.line = fit(points, stretch, options.gate).line;
  stretches = splitAtGaps(points, stretches, options);
  shareOut(points, stretches, options.gate);
  std::vector<Fit> fits;
  for (const auto& stretch : stretches) {
    const Fit found = fit(points, stretch, options.gate);
    if (found.inliers < options.min_points || lengthOf(points, found) < options.min_length) continue;
    fits.push_back(found);
  }
  return fits;
}

}  // namespace

std::shared_ptr<obs::CObservationLaserLines> LaserLineExtractor::extract(
    const mrpt::obs::CObservation2DRangeScan& scan) const {
  auto derived = obs::CObservationLaserLines::Create();
  derived->timestamp = scan.timestamp;
  derived->sensorPose = scan.sensorPose;
  derived->sensorLabel = scan.sensorLabel + kLinesSuffix;
  derived->source_label = scan.sensorLabel;

  const auto finder =
      options_.method == LaserLineOptions::Method::ransac ? makeRansac(options_) : makeSplitAndMerge(options_);
  std::vector<Stretch> stretches;
  const ScanPoints points = findLines(pointsOf(scan, options_), *finder, stretches);
  const auto fits = fitsOf(points, std::move(stretches), options_);
  derived->lines.reserve(fits.size());
  for (std::size_t i = 0; i < fits.size(); ++i) {
    const Fit& fit = fits[i];
    const Ends ends = endsOf(points, fits, i, options_.gate);
    obs::LaserLine line;
    line.segment_in_sensor = ends.segment;
    line.angle = geometry::wrapToPi(std::atan2(fit.line.ny, fit.line.nx));
    line.distance = fit.line.distance;
    line.covariance = fit.covariance;
    line.from_end = ends.from;
    line.to_end = ends.to;
    line.first_beam = static_cast<std::uint32_t>(points.beam[fit.first]);
    line.last_beam = static_cast<std::uint32_t>(points.beam[fit.last]);
    line.inliers = static_cast<std::uint32_t>(fit.inliers);
    line.rms = fit.rms;
    derived->lines.push_back(line);
  }
  return derived;
}

bool LaserLineExtractor::wants(const mrpt::obs::CObservation& raw) const {
  return dynamic_cast<const mrpt::obs::CObservation2DRangeScan*>(&raw) != nullptr;
}

std::vector<mrpt::obs::CObservation::Ptr> LaserLineExtractor::extract(const mrpt::obs::CObservation& raw) const {
  return {extract(dynamic_cast<const mrpt::obs::CObservation2DRangeScan&>(raw))};
}

std::vector<DerivedName> LaserLineExtractor::namesOf(const mrpt::obs::CObservation& raw) const {
  return {{CLASS_ID(obs::CObservationLaserLines), raw.sensorLabel + kLinesSuffix}};
}

}  // namespace omnimapper::perception
