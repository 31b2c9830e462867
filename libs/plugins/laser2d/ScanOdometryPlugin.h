#pragma once

#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservationPointCloud.h>
#include <omnimapper/matching/ScanMatcherOptions.h>
#include <omnimapper/matching/ScanTracker.h>
#include <omnimapper/matching/SpanContradiction.h>
#include <omnimapper/motion/OdometryCalibration.h>
#include <omnimapper/motion/OdometryClock.h>
#include <omnimapper/motion/OdometryErrors.h>
#include <omnimapper/motion/PoseTimeline.h>
#include <omnimapper/motion/WheelOdometry.h>
#include <omnimapper/perception/LaserPointsExtractor.h>
#include <omnimapper/plugin/PluginFactory.h>

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace omnimapper::plugins {

struct ScanOdometryOptions {
  std::string label;               ///< of the laser; empty: the first one observed
  std::string odometry_label;      ///< of the odometry used for prediction; empty: the one that fits the matches best
  double sweep = 0;                ///< [s] from the first beam of a scan, measured at its stamp, to the last
  double max_gap = 1.0;            ///< [s] longest time without a match; then matching starts anew
  double max_speed = 10.0;         ///< [m/s] largest of a prediction that is used
  double prediction_sigma = 0.01;  ///< [m]
  double guess_angle_sigma = 0.5 * base::option_text::kRadiansPerDegree;  ///< [rad]
  double prediction_sigma_per_m = 0.1;
  double point_sigma = 0.02;                                                 ///< [m] at least, of points from walls
  double position_noise_per_root_m = 0.01;                                   ///< [m / sqrt(m)]
  double yaw_noise_per_root_m = 0.2 * base::option_text::kRadiansPerDegree;  ///< [rad / sqrt(m)]
  double yaw_noise_per_root_turn = 0.005;                                    ///< [rad / sqrt(rad)]

  static const base::OptionTable<ScanOdometryOptions>& table();
};

/// Laser odometry as a continuous pose source (thesis 5.3.4): every scan of one laser, not only those of key frames, is
/// matched with a local map of the scans before it. Scans are processed in the order of their stamps; a scan that
/// arrives after a later one was processed is left out.
///
/// A match starts at a predicted motion. The prediction is that of the odometry which has recently agreed best with the
/// matches; it is a motion at constant velocity if that has agreed much better or if there is no odometry. The
/// prediction also determines directions that the walls leave unconstrained, so an odometry plugin beside this one
/// should be a fallback. The systematic errors of each odometry are estimated from the matches and corrected in its
/// predictions.
///
/// A scan that takes time (`sweep`) is deskewed with the predicted motion. Its stamp is the time of its first beam, but
/// its match gives the pose at the middle of the sweep, half a sweep later. Only the scans matched here are deskewed:
/// the clouds that loop closures and maps use stay as they were measured.
///
/// The plane of the laser must be nearly level (matching::kLargestTilt), either side up; other scans are left out.
class ScanOdometryPlugin : public mapper::PosePlugin {
 public:
  static constexpr const char* kName = "ScanOdometryPlugin";
  static constexpr const char* kSummary =
      "Laser odometry: matches every 2D scan with a local map of the scans before it.";

  ScanOdometryPlugin(const ScanOdometryOptions& options, const matching::ScanTrackerOptions& tracking,
                     const matching::ScanMatcherOptions& matching, const perception::LaserPointsOptions& points);

  Taken add(const mrpt::obs::CObservation::ConstPtr& observation) override;
  void processUntil(base::Stamp stamp) override;
  /// A scan without the beams that ended on things that move; null for a scan that repeats the ranges of an earlier one
  /// although the base had moved.
  mrpt::obs::CObservation::ConstPtr usablePart(const mrpt::obs::CObservation::ConstPtr& observation) const override;
  std::optional<mapper::RelativeMotion> between(base::Stamp begin, base::Stamp end) const override {
    return timeline_.between(begin, end);
  }
  std::optional<base::Stamp> coveredUntil() const override;
  std::vector<std::string> warnings() const override;
  /// Gaps across which neither laser nor odometry measured the motion; the share of points that moved; frozen scans;
  /// the time in which scans and odometry contradicted each other; and, if it is large, the share of the time in which
  /// neither of them measured the motion along one direction.
  std::vector<mapper::Evidence> evidence() const override;
  void forgetBefore(base::Stamp stamp) override;

 private:
  /// The motion to the next scan as one source predicts it, and the recent errors of that source.
  struct Predictor {
    std::optional<mrpt::math::TPose2D> motion;
    double error = 0;                            // [m], running mean
    double position_error = 0, angle_error = 0;  // [m2] [rad2], running mean squares
    bool is_judged = false;
  };
  struct Odometry {
    /// The motion between two stamps of the laser.
    std::optional<mapper::RelativeMotion> between(base::Stamp begin, base::Stamp end) const;

    std::string label;
    motion::WheelOdometry source;
    std::size_t readings = 0;  // that were taken
    base::Stamp begun;         // stamp of the first of them
    Predictor predictor;
    motion::OdometryCalibration calibration;
    motion::OdometryErrors errors;
    motion::OdometryClock clock;
    double learned_at = 0;                        // [s] offset of the clock at which the errors were learned
    std::optional<mrpt::math::TPose2D> measured;  // motion to the next scan, before it is corrected
    mrpt::math::TPose2D unseen;                   // motion up to the last scan since the ranges of the laser changed
  };
  /// Scans of a laser that were left out because of its tilt.
  struct Tilted {
    std::size_t scans = 0;
    double tilt = 0;  // [rad] the largest
  };
  /// Restarts of the matching across which no source measured the motion.
  struct Gaps {
    std::size_t count = 0;
    double first = 0;  // [s] after the first scan
  };
  /// The usual time between scans.
  struct Pace {
    std::optional<base::Stamp> last;  // stamp of the newest scan
    double seconds = 0;               // running mean
  };
  /// Scans that repeated the ranges of an earlier one while the wheels moved.
  struct Frozen {
    std::size_t scans = 0;
    double first = 0;  // [s] after the first scan
  };
  /// What moved, and was left out.
  struct Moving {
    std::size_t points = 0, of_points = 0;
  };
  static void judge(Predictor& predictor, const mrpt::math::TPose2D& motion);
  bool isOurs(const mrpt::obs::CObservation2DRangeScan& scan);
  void addOdometry(const mrpt::obs::CObservation& observation);
  double sinceTheLast(const mrpt::obs::CObservation2DRangeScan& scan);
  void follow(const mrpt::obs::CObservation2DRangeScan::ConstPtr& scan);
  bool isFrozen(const mrpt::obs::CObservation2DRangeScan& scan) const;
  void leaveOut(const mrpt::obs::CObservation2DRangeScan& scan);
  void addUpMotion(const mrpt::obs::CObservation2DRangeScan& matched);
  base::Stamp middleOf(const mrpt::obs::CObservation2DRangeScan& scan) const;
  /// The deskewed cloud of a scan in the base; `velocity` [m/s] [rad/s] of the base during the scan.
  matching::ScanWithNormals wallsOf(const mrpt::obs::CObservationPointCloud& cloud,
                                    const mrpt::obs::CObservation2DRangeScan& scan,
                                    const mrpt::math::TPose2D& velocity) const;
  std::vector<matching::MotionPrediction> predictions(base::Stamp stamp);
  bool isMeasuredByOdometry() const;
  const Odometry* mostAccurate() const;
  std::optional<matching::MeasuredMotion> measuredMotion() const;
  void bridge(base::Stamp stamp, bool is_carried);
  bool contradictsWheels(const matching::ScanWithNormals& walls, const Eigen::Vector2f& sensor, double gap);
  void learn(const matching::ScanTracker::Tracked& tracked, base::Stamp stamp);
  static void followTurns(Odometry& odometry);
  Eigen::Matrix2d contradictionOf(const matching::ScanTracker::Tracked& tracked, base::Stamp stamp);
  const Odometry* odometryLike(const mrpt::math::TPose2D& motion) const;
  void insertAlong(const Odometry& odometry, base::Stamp end, const mapper::RelativeMotion& measured);
  void restart(const mrpt::obs::CObservation2DRangeScan::ConstPtr& scan);
  mapper::RelativeMotion motionOf(const matching::ScanTracker::Tracked& tracked,
                                  const matching::MatchGuess& guess) const;

  ScanOdometryOptions options_;
  matching::ScanTrackerOptions tracking_;
  perception::LaserPointsExtractor extractor_;
  float near_;  // [m] from a point that moves, within which beams ended on the same
  matching::ScanTracker tracker_;
  std::vector<Odometry> odometries_;                                           // in order of arrival
  std::optional<std::string> label_;                                           // of the laser that is used
  std::map<std::string, Tilted> tilted_;                                       // by label
  std::map<base::Stamp, mrpt::obs::CObservation2DRangeScan::ConstPtr> queue_;  // not yet processed
  std::optional<base::Stamp> reached_;                                         // stamp of the scan processed last
  std::optional<base::Stamp> last_;   // middle of the scan that was matched last
  std::optional<base::Stamp> begun_;  // middle of the first scan of all
  Gaps gaps_;
  Pace pace_;
  std::vector<double> broken_;  // [s] after the first scan: gaps in which the base was carried
  Frozen frozen_;
  bool is_stuck_ = false;  // the laser has repeated itself for long, and still does
  Moving moving_;
  matching::SpanContradiction contradiction_;             // of scans and odometry
  double heading_ = 0;                                    // [rad] since the first scan
  mrpt::obs::CObservation2DRangeScan::ConstPtr matched_;  // the scan that was matched last, or restarted with
  /// Of scans of which not all is usable, by stamp: points of things that move, in the base [m]; none if nothing is.
  std::map<base::Stamp, std::optional<std::vector<Eigen::Vector2f>>> unusable_;
  // Time in which the walls left a direction unconstrained and no odometry measured the motion.
  double blind_seconds_ = 0;
  double seeing_seconds_ = 0;     // all other time in which scans were matched
  bool is_first_ = true;          // no scan was matched since the last restart
  mrpt::math::TPose2D velocity_;  // [m/s] [rad/s] in the base
  Predictor by_velocity_;
  double noise_;  // [m] deviation of points from their walls, in recent matches
  motion::PoseTimeline timeline_;
};

}  // namespace omnimapper::plugins
