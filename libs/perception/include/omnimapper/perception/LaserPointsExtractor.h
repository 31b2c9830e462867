#pragma once

#include <mrpt/obs/CObservation2DRangeScan.h>
#include <omnimapper/base/OptionTable.h>
#include <omnimapper/perception/Extractor.h>

#include <string>
#include <vector>

namespace omnimapper::perception {

struct LaserPointsOptions {
  double min_range = 0.1;          ///< [m]
  double max_range = 40.0;         ///< [m]; the sensor's own limit applies too
  double spacing = 0.05;           ///< [m] between kept points along the scan; 0 keeps all
  double isolated_distance = 0.5;  ///< [m] a point this far from both of its neighbours is dropped, because its beam
                                   ///< probably hit the edge of something and what is behind it; 0 keeps all

  static const base::OptionTable<LaserPointsOptions>& table();
};

/// Extracts the valid beams of a 2D scan as points that are evenly spaced along the walls: near walls would otherwise
/// outweigh far ones.
class LaserPointsExtractor : public Extractor {
 public:
  static constexpr const char* kName = "LaserPointsExtractor";
  static constexpr const char* kSummary = "Valid beams of 2D scans as evenly spaced points.";

  explicit LaserPointsExtractor(const LaserPointsOptions& options) : options_(options) {}

  /// Label of the points that are made of scans with the label `scan_label`.
  static std::string labelOf(const std::string& scan_label) { return scan_label + ".points"; }
  /// Whether the observation was made by such an extractor, in this run or in an earlier one that wrote it to a log.
  static bool made(const mrpt::obs::CObservation& observation);

  /// A CObservationPointCloud with the scan's stamp and sensorPose, with points in the sensor frame [m], and with the
  /// label "<scan label>.points". Beams that are invalid, not finite, out of range or at the sensor's own limit (no
  /// echo) give no point. Thread-safe.
  mrpt::obs::CObservation::Ptr extract(const mrpt::obs::CObservation2DRangeScan& scan) const;

  bool wants(const mrpt::obs::CObservation& raw) const override;
  std::vector<mrpt::obs::CObservation::Ptr> extract(const mrpt::obs::CObservation& raw) const override;
  std::vector<DerivedName> namesOf(const mrpt::obs::CObservation& raw) const override;

 private:
  LaserPointsOptions options_;
};

}  // namespace omnimapper::perception
