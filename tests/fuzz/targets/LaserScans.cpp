#include <mrpt/maps/CPointsMap.h>
#include <mrpt/obs/CObservationPointCloud.h>
#include <omnimapper/perception/LaserLineExtractor.h>
#include <omnimapper/perception/LaserPointsExtractor.h>

#include <cmath>

#include "../Input.h"
#include "../Targets.h"

namespace omnimapper::fuzz {

namespace {

using namespace perception;

// Beams that hit walls, noise, odd values, or ranges that are all from the input.
mrpt::obs::CObservation2DRangeScan takeScan(Input& input) {
  constexpr float kOdd[] = {
      std::numeric_limits<float>::quiet_NaN(), 0, std::numeric_limits<float>::infinity(), -1, 1e-30F, 1e30F, 80, 39.9F};
  mrpt::obs::CObservation2DRangeScan scan;
  scan.sensorLabel = "laser";
  scan.aperture = static_cast<float>(input.oddBetween(0, 6.5));
  scan.maxRange = static_cast<float>(input.oddBetween(0, 80));
  scan.rightToLeft = input.flag();
  const int beams = input.flag() ? input.below(4) : input.below(1100);
  scan.resizeScan(static_cast<std::size_t>(beams));
  for (int i = 0; i < beams; ++i) {
    scan.setScanRange(static_cast<std::size_t>(i), 5);
    scan.setScanRangeValidity(static_cast<std::size_t>(i), true);
  }
  for (int strokes = 0; !input.atEnd() && beams > 0 && strokes < 40; ++strokes) {
    const int kind = input.take<std::uint8_t>(), first = input.below(beams), last = first + input.below(beams - first);
    const double turn = input.between(-3.2, 3.2), distance = input.oddBetween(0.05, 20);
    std::uint32_t random = static_cast<std::uint32_t>(kind) * 2654435761U + 1;
    const double step = beams > 1 ? static_cast<double>(scan.aperture) / (beams - 1) : 0;
    for (int i = first; i <= last; ++i) {
      const auto beam = static_cast<std::size_t>(i);
      random = random * 1664525U + 1013904223U;
      const double wall = distance / std::cos(step * i - turn);
      if (kind < 96) {
        scan.setScanRange(beam, static_cast<float>(wall));
      } else if (kind < 144) {
        scan.setScanRange(beam, static_cast<float>(wall + (random >> 24) * 2e-4));
      } else if (kind < 176) {
        scan.setScanRange(beam, kOdd[static_cast<std::size_t>(kind) % std::size(kOdd)]);
      } else if (kind < 192) {
        scan.setScanRange(beam, static_cast<float>((random >> 16) * 1e-3));
      } else if (kind < 224) {
        scan.setScanRangeValidity(beam, (random >> 28) < static_cast<unsigned>(kind % 16));
      } else {
        scan.setScanRange(beam,
                          kind % 2 == 0 ? static_cast<float>(input.take<std::uint8_t>()) * 0.1F : input.take<float>());
      }
    }
  }
  return scan;
}

LaserLineOptions takeLaserOptions(Input& input) {
  LaserLineOptions options;
  options.method = input.flag() ? LaserLineOptions::Method::ransac : LaserLineOptions::Method::split_and_merge;
  options.min_range = input.between(0, 1);
  options.max_range = input.between(1, 100);
  options.range_sigma = input.between(1e-6, 0.1);
  options.beam_width = input.flag() ? 0 : input.between(0, 0.17);
  options.roughness = input.flag() ? 0 : input.between(0, 0.1);
  options.gate = input.between(0.1, 10);
  options.max_gap = input.between(0, 3);
  options.min_length = input.between(1e-3, 1);
  options.min_points = 3 + input.below(10);
  options.ransac_trials = 1 + input.below(60);
  options.seed = input.below(1000);
  return options;
}

void requireSound(const obs::CObservationLaserLines& found, const mrpt::obs::CObservation2DRangeScan& scan,
                  const LaserLineOptions& options) {
  for (const obs::LaserLine& line : found.lines) {
    require(line.first_beam < scan.getScanSize() && line.last_beam < scan.getScanSize(), "a beam of no scan");
    require(static_cast<int>(line.inliers) >= options.min_points, "a line of too few points");
    require(line.segment_in_sensor.from.allFinite() && line.segment_in_sensor.to.allFinite(),
            "an end that is not finite");
    require(std::isfinite(line.angle) && line.distance >= 0, "a line that is not finite");
    require(line.covariance.allFinite(), "a covariance that is not finite");
    require(std::isfinite(line.rms), "a deviation that is not finite");
  }
}

}  // namespace

void laserScans(const std::uint8_t* data, std::size_t size) {
  Input input(data, size);
  const LaserLineOptions options = takeLaserOptions(input);
  LaserPointsOptions of_points;
  of_points.spacing = input.between(0, 0.5);
  of_points.isolated_distance = input.between(0, 2);
  const auto scan = takeScan(input);
  requireSound(*LaserLineExtractor(options).extract(scan), scan, options);
  const auto points =
      std::dynamic_pointer_cast<mrpt::obs::CObservationPointCloud>(LaserPointsExtractor(of_points).extract(scan));
  require(points && points->pointcloud && points->pointcloud->size() <= scan.getScanSize(), "more points than beams");
  for (const float x : points->pointcloud->getPointsBufferRef_x())
    require(std::isfinite(x), "a point that is not finite");
}

}  // namespace omnimapper::fuzz
