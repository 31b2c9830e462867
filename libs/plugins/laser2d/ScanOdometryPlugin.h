#pragma once

#include <mrpt/obs/CObservation2DRangeScan.h>
#include <omnimapper/matching/OdometryCalibration.h>
#include <omnimapper/matching/PoseTimeline.h>
#include <omnimapper/matching/ScanMatcherOptions.h>
#include <omnimapper/matching/ScanTracker.h>
#include <omnimapper/matching/WheelOdometry.h>
#include <omnimapper/perception/LaserPointsExtractor.h>
#include <omnimapper/plugin/PluginFactory.h>

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace omnimapper::plugins {

struct ScanOdometryOptions {
  std::string label;               ///< of the laser; empty: the first that comes
  std::string odometry_label;      ///< of the odometry that predicts; empty: the best of all
  double sweep = 0;                ///< [s] from the first beam of a scan, when it is stamped, to the last
  double max_gap = 1.0;            ///< [s] between scans that are matched
  double max_speed = 10.0;         ///< [m/s] of a prediction
  double prediction_sigma = 0.01;  ///< [m]
  double guess_angle_sigma = 0.5 * base::option_text::kRadiansPerDegree;  ///< [rad]
  double prediction_sigma_per_m = 0.1;
  double point_sigma = 0.02;                                                 ///< [m] at least
  double position_noise_per_root_m = 0.01;                                   ///< [m / sqrt(m)]
  double yaw_noise_per_root_m = 0.2 * base::option_text::kRadiansPerDegree;  ///< [rad / sqrt(m)]
  double yaw_noise_per_root_turn = 0.005;                                    ///< [rad / sqrt(rad)]
  matching::ScanTrackerOptions tracker;

  static const base::OptionTable<ScanOdometryOptions>& table();
};

/// Laser odometry as a continuous pose source (thesis 5.3.4): every scan of one laser, not those of key frames alone,
/// is matched against a local map of the scans before it. Scans are worked on in the order of their stamps; one that
/// comes after its time was worked on is left out. Odometry, of several that which agreed best with the matches of
/// late, or steady motion where that is better or there is none, says where a match begins, and counts where the walls
/// leave a direction open: beside this it should be a fallback. What each odometry errs by systematically is learned
/// from the matches and taken out of what it predicts.
///
/// Of a laser that takes its time (`sweep`) the same prediction tells how the base moved during a scan. The stamp is
/// the instant of the first beam; the scan counts for the middle of the sweep, half of it later. Only what is matched
/// here is straightened: the clouds that loop closures and maps use stay as they were measured.
///
/// The plane of the laser must be nearly that of the floor (kLargestTilt), either side up; other scans are left out.
class ScanOdometryPlugin : public mapper::PosePlugin {
 public:
  ScanOdometryPlugin(const ScanOdometryOptions& options, const matching::ScanMatcherOptions& matching,
                     const perception::LaserPointsOptions& points);

  Taken add(const mrpt::obs::CObservation::ConstPtr& observation) override;
  void processUntil(base::Stamp stamp) override;
  std::optional<mapper::RelativeMotion> between(base::Stamp begin, base::Stamp end) const override {
    return timeline_.between(begin, end);
  }
  std::optional<base::Stamp> coveredUntil() const override;
  std::vector<std::string> warnings() const override;
  /// Gaps across which neither the laser nor an odometry told the motion, if there are any.
  std::vector<mapper::Evidence> evidence() const override;
  void forgetBefore(base::Stamp stamp) override { timeline_.forgetBefore(stamp); }

 private:
  /// What tells the motion to the next scan, and how far off it was of late.
  struct Predictor {
    std::optional<mrpt::math::TPose2D> motion;
    double error = 0;                            // [m], a mean over some scans
    double position_error = 0, angle_error = 0;  // [m2] [rad2] mean squares over some scans
    bool is_judged = false;
  };
  struct Odometry {
    std::string label;
    matching::WheelOdometry source;
    Predictor predictor;
    matching::OdometryCalibration calibration;
    std::optional<mrpt::math::TPose2D> told;  // motion to the next scan, before it is corrected
  };
  /// Scans of a laser that were left out.
  struct Tilted {
    std::size_t scans = 0;
    double tilt = 0;  // [rad] the largest
  };
  /// Times at which the laser began anew and nothing told how it had got there.
  struct Gaps {
    std::size_t count = 0;
    double first = 0;  // [s] after the first scan
  };
  static void judge(Predictor& predictor, const mrpt::math::TPose2D& motion);
  bool isOurs(const mrpt::obs::CObservation2DRangeScan& scan);
  void addOdometry(const mrpt::obs::CObservation& observation);
  void follow(const mrpt::obs::CObservation2DRangeScan& scan);
  base::Stamp middleOf(const mrpt::obs::CObservation2DRangeScan& scan) const;
  /// In the base; `velocity` [m/s] [rad/s] during the scan.
  matching::ScanWithNormals wallsOf(const mrpt::obs::CObservation2DRangeScan& scan,
                                    const mrpt::math::TPose2D& velocity) const;
  std::vector<matching::MotionPrediction> predictions(base::Stamp stamp);
  bool isTold() const;
  const Odometry* odometryLike(const mrpt::math::TPose2D& motion) const;
  void insertAlong(const Odometry& odometry, base::Stamp end, const mapper::RelativeMotion& told);
  void restart(const mrpt::obs::CObservation2DRangeScan& scan);
  mapper::RelativeMotion motionOf(const matching::ScanTracker::Tracked& tracked,
                                  const matching::MatchGuess& guess) const;

  ScanOdometryOptions options_;
  perception::LaserPointsExtractor extractor_;
  matching::ScanTracker tracker_;
  std::vector<Odometry> odometries_;                                          // in the order they came
  std::optional<std::string> label_;                                          // of the first that came
  std::map<std::string, Tilted> tilted_;                                      // by label
  std::map<base::Stamp, mrpt::obs::CObservation2DRangeScan::ConstPtr> wait_;  // for their time
  std::optional<base::Stamp> reached_;                                        // scan that was worked on last
  std::optional<base::Stamp> last_;   // middle of the scan that was matched last
  std::optional<base::Stamp> begun_;  // middle of the first scan of all
  Gaps gaps_;
  double blind_seconds_ = 0;      // in which the walls left a direction open, and no odometry told the motion
  double seeing_seconds_ = 0;     // all others that it followed the base
  bool is_first_ = true;          // whether none was before it
  mrpt::math::TPose2D velocity_;  // [m/s] [rad/s] in the base
  Predictor by_velocity_;
  double noise_;  // [m] of points from the walls they lie on, by the matches of late
  matching::PoseTimeline timeline_;
};

class ScanOdometryPluginFactory : public mapper::PosePluginFactory {
  DEFINE_MRPT_OBJECT(ScanOdometryPluginFactory, omnimapper::plugins)
 public:
  std::string name() const override { return "ScanOdometryPlugin"; }
  std::string summary() const override { return "Laser odometry: every 2D scan against those just before it."; }
  const std::vector<base::OptionSpec>& options() const override;
  std::unique_ptr<mapper::PosePlugin> make(const base::ConfigSection& section,
                                           const mapper::PluginContext& context) const override;
};

}  // namespace omnimapper::plugins
