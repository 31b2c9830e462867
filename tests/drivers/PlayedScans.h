#pragma once

#include <gtest/gtest.h>
#include <mrpt/obs/CObservation3DRangeScan.h>
#include <omnimapper/source/RawlogSource.h>
#include <omnimapper/testing/Fixtures.h>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "../live/Observations.h"

/// Depth images that are played to drivers, and how to read what was recorded.
namespace omnimapper::drivers::range_scans {

using Scan = mrpt::obs::CObservation3DRangeScan;
using Scans = std::vector<Scan::Ptr>;

/// The first depths and pictures of the simulated home, a tenth of a second apart.
inline Scans simulated(std::size_t count) {
  Scans scans;
  source::RawlogSource log(testing::sourceFile("rawlogs/home_30s/home_30s.rawlog"));
  while (const auto observation = scans.size() < count ? log.next() : nullptr) {
    auto scan = std::dynamic_pointer_cast<Scan>(observation);
    if (!scan) continue;
    scan->timestamp = live::observations::at(0.1 * static_cast<double>(scans.size()));
    scans.push_back(scan);
  }
  return scans;
}

/// Depths of 2 m and grey pictures, for tests in which only the arrival of images matters.
inline Scans flat(std::size_t count) {
  Scans scans;
  for (std::size_t i = 0; i < count; ++i) {
    auto& scan = scans.emplace_back(Scan::Create());
    scan->timestamp = live::observations::at(0.1 * static_cast<double>(i));
    scan->sensorLabel = "flat";
    scan->range_is_depth = scan->hasRangeImage = scan->hasIntensityImage = true;
    scan->rangeUnits = 0.001F;
    scan->rangeImage_setSize(480, 640);
    scan->rangeImage.fill(2000);
    scan->intensityImage = mrpt::img::CImage(640, 480, mrpt::img::CH_RGB);
    scan->intensityImage.filledRectangle(0, 0, 639, 479, mrpt::img::TColor(99, 99, 99));
  }
  return scans;
}

/// All observations of this class in a rawlog.
template <class Observation>
std::vector<std::shared_ptr<Observation>> recorded(const std::string& path) {
  std::vector<std::shared_ptr<Observation>> all;
  source::RawlogSource log(path);
  while (const auto observation = log.next()) {
    if (auto one = std::dynamic_pointer_cast<Observation>(observation)) all.push_back(one);
  }
  return all;
}

inline bool isSamePicture(const Scan& seen, const Scan& played) {
  if (!seen.hasIntensityImage || !(seen.intensityImage.getSize() == played.intensityImage.getSize())) return false;
  const std::size_t width = 3 * seen.intensityImage.getWidth();
  for (unsigned row = 0; row < seen.intensityImage.getHeight(); ++row) {
    const auto* a = seen.intensityImage.ptrLine<std::uint8_t>(row);
    if (!std::equal(a, a + width, played.intensityImage.ptrLine<std::uint8_t>(row))) return false;
  }
  return true;
}

}  // namespace omnimapper::drivers::range_scans
