#include "ScanStatistics.h"

#include <omnimapper/grid/ScanBeams.h>
#include <omnimapper/matching/ScanInBase.h>
#include <omnimapper/perception/LaserPointsExtractor.h>

#include <algorithm>
#include <cmath>

#include "Quantile.h"

namespace omnimapper::check {

namespace {

constexpr std::size_t kSampledBeam = 7;  // every seventh valid beam is sampled
constexpr std::size_t kMostSamples = 1'000'000;

// Whether the mapper would take the beam as one that met something.
bool isValid(const mrpt::obs::CObservation2DRangeScan& scan, std::size_t beam) {
  static const perception::LaserPointsOptions limits;
  const double range = scan.getScanRange(beam);
  return scan.getScanRangeValidity(beam) && std::isfinite(range) && range >= limits.min_range &&
         range <= limits.max_range && range < scan.maxRange;
}

template <class Test>
bool all(const mrpt::obs::CObservation2DRangeScan& scan, Test test) {
  for (std::size_t i = 0; i < scan.getScanSize(); ++i) {
    if (!test(scan.getScanRange(i))) return false;
  }
  return true;
}

}  // namespace

bool ScanFacts::isAtOrigin() const {
  // A small angle is no mounting angle: importers rotate the sensor by half a beam.
  constexpr double kLittle = 2 * base::option_text::kRadiansPerDegree;
  const auto& p = base_from_sensor;
  return p.translation().norm() < 1e-6 && std::abs(p.yaw()) < kLittle && std::abs(p.pitch()) < kLittle &&
         std::abs(p.roll()) < kLittle;
}

bool ScanFacts::isUpsideDown() const {
  return base_from_sensor.getRotationMatrix()(2, 2) < 0;
}

double ScanFacts::tilt() const {
  return matching::tiltOf(base_from_sensor);
}

void ScanStatistics::add(const mrpt::obs::CObservation2DRangeScan& scan) {
  if (facts_.scans++ == 0) facts_.base_from_sensor = scan.sensorPose;
  if (!(scan.sensorPose == facts_.base_from_sensor)) facts_.sensor_pose_moves = true;
  const std::size_t beams = scan.getScanSize();
  if (beams == 0) {
    ++facts_.empty;
    return;
  }
  if (facts_.beams == 0) {
    facts_.beams = beams;
    facts_.aperture = scan.aperture;
  }
  facts_.max_range = std::max(facts_.max_range, static_cast<double>(scan.maxRange));
  if (beams != facts_.beams) ++facts_.other_beams;
  facts_.fewest_beams = facts_.most_beams == 0 ? beams : std::min(facts_.fewest_beams, beams);
  facts_.most_beams = std::max(facts_.most_beams, beams);
  if (!scan.rightToLeft) ++facts_.clockwise;

  std::vector<float> ranges(beams);
  std::size_t valid = 0;
  for (std::size_t i = 0; i < beams; ++i) {
    ranges[i] = scan.getScanRange(i);
    if (!isValid(scan, i) || ranges[i] > max_range_) continue;
    if (++valid % kSampledBeam == 0 && sampled_.size() < kMostSamples) sampled_.push_back(ranges[i]);
    addRange(ranges[i]);
  }
  const grid::BeamEnds ends(scan, {}, grid::BeamEnds::Pose::of_sensor);
  for (std::size_t i = 0; i < beams; ++i) singles_ += ends.valid(i) && !ends.clears(i);
  all_beams_ += beams;
  valid_beams_ += valid;
  if (valid == 0) {
    addBlind(scan);
  } else if (ranges == previous_) {
    ++facts_.repeated;
  }
  previous_ = std::move(ranges);
}

void ScanStatistics::addBlind(const mrpt::obs::CObservation2DRangeScan& scan) {
  ++facts_.blind;
  if (all(scan, [](float range) { return range == 0; })) {
    ++facts_.all_zero;
  } else if (all(scan, [&](float range) { return range >= scan.maxRange; })) {
    ++facts_.all_maximum;
  }
}

void ScanStatistics::addRange(float range) {
  if (range > facts_.longest) {
    facts_.longest = range;
    at_longest_ = 0;
  }
  if (range == static_cast<float>(facts_.longest)) ++at_longest_;
}

ScanFacts ScanStatistics::facts() const {
  ScanFacts facts = facts_;
  if (all_beams_ > 0) facts.valid_share = static_cast<double>(valid_beams_) / static_cast<double>(all_beams_);
  if (all_beams_ > 0) facts.single_share = static_cast<double>(singles_) / static_cast<double>(all_beams_);
  if (valid_beams_ > 0) facts.longest_share = static_cast<double>(at_longest_) / static_cast<double>(valid_beams_);
  constexpr double kBelow = 0.95, kFarMore = 3;
  constexpr std::ptrdiff_t kFewest = 20;
  const auto longest = static_cast<float>(facts.longest);
  const auto at = std::count(sampled_.begin(), sampled_.end(), longest);
  const auto below = std::count_if(sampled_.begin(), sampled_.end(),
                                   [&](float range) { return range < longest && range > kBelow * longest; });
  facts.longest_stands_out = at >= kFewest && static_cast<double>(at) > kFarMore * static_cast<double>(below);
  if (!sampled_.empty()) facts.median_range = quantile(sampled_, 0.5);
  return facts;
}

}  // namespace omnimapper::check
