#pragma once

#include <mrpt/obs/CObservation2DRangeScan.h>
#include <omnimapper/check/LogFacts.h>

#include <limits>
#include <vector>

namespace omnimapper::check {

/// Statistics on the scans of one label.
class ScanStatistics {
 public:
  /// `max_range` [m]: beams that are longer count as if they had no echo, as the mapper takes them.
  explicit ScanStatistics(double max_range = std::numeric_limits<double>::infinity()) : max_range_(max_range) {}
  void add(const mrpt::obs::CObservation2DRangeScan& scan);
  ScanFacts facts() const;

 private:
  void addBlind(const mrpt::obs::CObservation2DRangeScan& scan);
  void addRange(float range);

  ScanFacts facts_;
  std::size_t all_beams_ = 0, valid_beams_ = 0, at_longest_ = 0;
  double max_range_;
  std::size_t singles_ = 0;      // beams without an echo amid others with one
  std::vector<float> previous_;  // [m] ranges of the scan before
  std::vector<float> sampled_;   // [m] valid ranges, of some beams
};

}  // namespace omnimapper::check
