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
  double range_sigma = 0.01;  ///< [m] standard deviation of a range
  /// Full opening angle of a beam [rad]; its echo may come from anywhere within this angle.
  double beam_width = 0.25 * base::option_text::kRadiansPerDegree;
  double roughness = 0.005;  ///< [m] standard deviation of a wall's surface from a flat one
  double gate = 4;           ///< [-] standard deviations; a point farther from a line is not on it
  double max_gap = 0.5;      ///< [m] a line is split where, over a longer distance, beams along it met something else
  double min_length = 0.4;   ///< [m]
  int min_points = 6;        ///< least number of beams on a line
  int ransac_trials = 60;    ///< number of point pairs that are drawn for each line
  int seed = 1;              ///< of the random numbers that draw the pairs

  static const base::OptionTable<LaserLineOptions>& table();
};

/// The label of a scan's lines is the scan's label with this suffix.
inline constexpr char kLinesSuffix[] = ".lines";

/// Extracts the straight walls of a 2D scan (thesis 3.2). There are two methods to find which beams belong together.
/// RANSAC, as in the thesis, draws lines through random pairs of points and takes the line with most points first.
/// Split and merge splits the scan where it bends most, and merges pieces that lie on one line. The further steps are
/// the same for both methods. How far a point may be from its line follows from the noise of the range and from the
/// width of the beam where it meets the wall. Lines are fitted by total least squares, weighted according to the same
/// noise. Walls that meet end at their common corner.
class LaserLineExtractor : public Extractor {
 public:
  static constexpr const char* kName = "LaserLineExtractor";
  static constexpr const char* kSummary = "Straight walls of 2D scans as lines with ends and covariance.";

  explicit LaserLineExtractor(const LaserLineOptions& options) : options_(options) {}

  /// The lines of a scan, with its stamp and sensorPose and the label "<scan label>.lines". Beams that are invalid, not
  /// finite, out of range or at the sensor's own limit (no echo) are left out. In a scan of 360 degrees, a line may
  /// continue across the end of the scan: its first beam then has a larger index than its last one. Thread-safe; the
  /// same scan gives the same bits.
  std::shared_ptr<obs::CObservationLaserLines> extract(const mrpt::obs::CObservation2DRangeScan& scan) const;

  bool wants(const mrpt::obs::CObservation& raw) const override;
  std::vector<mrpt::obs::CObservation::Ptr> extract(const mrpt::obs::CObservation& raw) const override;
  std::vector<DerivedName> namesOf(const mrpt::obs::CObservation& raw) const override;

 private:
  LaserLineOptions options_;
};

}  // namespace omnimapper::perception
