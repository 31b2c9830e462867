#pragma once

#include <mrpt/obs/CObservation2DRangeScan.h>
#include <omnimapper/base/OptionTable.h>
#include <omnimapper/obs/CObservationLaserLines.h>
#include <omnimapper/perception/Extractor.h>

namespace omnimapper::perception {

struct LaserLineOptions {
  enum class Method { ransac, split_and_merge };
  Method method = Method::split_and_merge;
  double min_range = 0.1;     ///< [m]
  double max_range = 40.0;    ///< [m]; the sensor's own limit applies too
  double range_sigma = 0.01;  ///< [m] deviation of a range
  /// Full angle of a beam: what it may have met to the left and right of its middle [rad].
  double beam_width = 0.25 * base::option_text::kRadiansPerDegree;
  double roughness = 0.005;  ///< [m] deviation of a wall from flat
  double gate = 4;           ///< deviations; a point farther from a line than that is not on it
  double max_gap = 0.5;      ///< [m] of a line where beams met something else; it is two lines if there is more
  double min_length = 0.4;   ///< [m]
  int min_points = 6;        ///< beams on a line
  int ransac_trials = 60;    ///< pairs of points drawn for each line
  int seed = 1;              ///< of those pairs

  static const base::OptionTable<LaserLineOptions>& table();
};

/// What the label of a scan's lines has behind the scan's own.
inline constexpr char kLinesSuffix[] = ".lines";

/// The straight walls that a 2D scan shows (thesis 3.2). Two methods find which beams belong together: random pairs of
/// points, the line with most points first, as the thesis has it; or splitting the scan where it bends most and merging
/// what lies on one line. The rest is one: how far a point may be off is told by the noise of range and the width of
/// the beam where it meets the wall; weighted total least squares with that noise; walls that meet end in their corner.
class LaserLineExtractor : public Extractor {
 public:
  static constexpr const char* kName = "LaserLineExtractor";
  static constexpr const char* kSummary = "Straight walls of 2D scans as lines with ends and covariance.";

  explicit LaserLineExtractor(const LaserLineOptions& options) : options_(options) {}

  /// Lines with the scan's stamp and sensorPose, label "<scan label>.lines". Beams that are invalid, not finite, out of
  /// range or at the sensor's own limit, where nothing came back, are as good as not there. In a scan all round a line
  /// may go on over the end of the scan: its first beam is then the larger. Thread-safe; the same scan gives the same
  /// bits.
  std::shared_ptr<obs::CObservationLaserLines> extract(const mrpt::obs::CObservation2DRangeScan& scan) const;

  bool wants(const mrpt::obs::CObservation& raw) const override;
  std::vector<mrpt::obs::CObservation::Ptr> extract(const mrpt::obs::CObservation& raw) const override;
  std::vector<DerivedName> namesOf(const mrpt::obs::CObservation& raw) const override;

 private:
  LaserLineOptions options_;
};

}  // namespace omnimapper::perception
