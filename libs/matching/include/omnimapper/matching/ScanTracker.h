#pragma once

#include <omnimapper/base/OptionTable.h>
#include <omnimapper/grid/BeamScan.h>
#include <omnimapper/matching/BeamFit.h>
#include <omnimapper/matching/MovingThings.h>
#include <omnimapper/matching/ScanMatcher.h>

#include <deque>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

namespace omnimapper::grid {
class HitMissGrid;
class LikelihoodPyramid;
}  // namespace omnimapper::grid

namespace omnimapper::matching {

struct ScanTrackerOptions {
  int local_scans = 40;                                              ///< largest number of scans in the local map
  double local_distance = 0.25;                                      ///< [m] distance after which a scan is added to it
  double local_angle = 10.0 * base::option_text::kRadiansPerDegree;  ///< [rad] turn after which a scan is added to it
  double min_overlap = 0.4;     ///< smallest share of a scan's points that must have a correspondence
  double max_correction = 0.5;  ///< [m] largest correction of a prediction by a match
  double max_turn_correction = 20 * base::option_text::kRadiansPerDegree;  ///< [rad] largest correction of its heading

  static const base::OptionTable<ScanTrackerOptions>& table();
};

/// A prediction of the motion since the last scan.
struct MotionPrediction {
  MatchGuess guess;
  /// Standard deviations [m] [rad], from recent errors of the source of the prediction.
  double position_sigma = 1, angle_sigma = 1;
  /// Largest possible errors [m] [rad]: how far a base can get from the prediction by accelerating.
  double most_position = std::numeric_limits<double>::infinity(), most_angle = most_position;
  /// Whether the motion is unknown, as after a gap in the data. The pose of the scan is then searched up to 3 m around,
  /// at all headings, and the beams alone must show that it fits.
  bool is_blind = false;
};

/// The motion since the last scan as a sensor other than the laser measured it, such as wheels.
struct MeasuredMotion {
  mrpt::math::TPose2D motion;
  Eigen::Matrix3d covariance;  ///< x y yaw at the end of the motion [m] [rad], as the recent errors of the sensor show
};

/// Tracks a laser from scan to scan: each scan is matched against a local map of some scans before it, so that the
/// error of one scan is not passed on to the next. Poses are in the frame that the scans are given in.
///
/// The most trusted prediction is matched first. Every other prediction that would not have led to the same match is
/// tried, too. The matches are candidates, and so are predictions that led to no match. The most probable candidate is
/// taken. Its probability follows from the walls and the free space of the local map and from all predictions together
/// (Olson 2009; Thrun, Burgard and Fox 2005, 6.3). If the candidate taken is not a match, there is no result.
///
/// What moves (MovingThings) neither pulls a match nor enters the local map. A measured motion is combined with the
/// match in each direction by what both say, where the match says only what standing points determine. If they differ
/// by more than both allow, the measured motion counts the less, the more they differ: wheels slip, walls do not.
class ScanTracker {
 public:
  ScanTracker(const ScanTrackerOptions& options, std::shared_ptr<const ScanMatcher> matcher);
  ~ScanTracker();
  ScanTracker(ScanTracker&&) noexcept;
  ScanTracker& operator=(ScanTracker&&) noexcept;

  /// Forgets all scans and begins with this one. `sensor`: position of the laser in the scan's frame [m]; `seconds`:
  /// time of the scan.
  void restart(ScanWithNormals scan, const Eigen::Vector2f& sensor, double seconds);
  struct Tracked {
    ScanMatch match;             ///< match with the local map, but its pose is the motion since the last scan
    std::size_t prediction = 0;  ///< index of the prediction that led to the match
    /// What other, less probable matches and wheels that contradict the match add to the covariance, in the scan's
    /// frame: x y yaw [m] [rad].
    Eigen::Matrix3d search_covariance = Eigen::Matrix3d::Zero();
    /// From the motion that was taken to the match, x y in the scan's frame [m], and the covariance of that difference.
    /// Both are zero without a measured motion.
    Eigen::Vector2d difference = Eigen::Vector2d::Zero();
    Eigen::Matrix2d difference_covariance = Eigen::Matrix2d::Zero();
    /// Of the match, by what stands: x y yaw in the scan's frame.
    Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
    /// Whether standing points alone determine the motion in all directions, to kDetermined and kDeterminedYaw.
    bool is_determined = false;
    std::vector<std::size_t> moving;  ///< points of the scan that belong to things that move
    std::size_t points = 0;           ///< number of points of the scan, with these
  };
  static constexpr double kDetermined = 0.02, kDeterminedYaw = 0.01;  ///< [m] [rad] standard deviations
  /// Matches a scan and makes it the last one. `predictions`: the most trusted one first. `seconds`: as in restart().
  /// None, and nothing changes, if no prediction leads to a match, or if the most probable candidate is not a match.
  /// Where more than half of the points move and the others do not match, the measured motion is taken as it is.
  std::optional<Tracked> track(ScanWithNormals scan, const Eigen::Vector2f& sensor,
                               const std::vector<MotionPrediction>& predictions, double seconds,
                               const std::optional<MeasuredMotion>& measured = std::nullopt);
  /// How the beams of a scan fit the local map at the motion since the last scan, and around it: up to `distance` [m]
  /// and `angle` [rad] away. None before the first scan.
  std::optional<BeamFit> fitAround(const ScanWithNormals& scan, const Eigen::Vector2f& sensor,
                                   const mrpt::math::TPose2D& motion, double distance, double angle);

 private:
  struct Local {
    mrpt::math::TPose2D track_from_scan;
    ScanWithNormals scan;
    Eigen::Vector2f sensor;
  };
  struct Candidates;
  std::vector<Tracked> matchesOf(const ScanWithNormals& scan, const std::vector<MotionPrediction>& predictions,
                                 const mrpt::math::TPose2D& local_from_last) const;
  std::optional<Tracked> matched(const ScanWithNormals& standing, const Eigen::Vector2f& sensor,
                                 const std::vector<MotionPrediction>& predictions);
  void search(Candidates& candidates);
  static void addPredictions(Candidates& candidates);
  void weigh(Candidates& candidates);
  static Tracked mostProbable(const Candidates& candidates);
  void remember(ScanWithNormals scan, const Eigen::Vector2f& sensor);
  bool forget(const std::vector<int>& things);
  void prepare();
  ScanWithNormals localMap() const;
  const grid::HitMissGrid& beams();

  ScanTrackerOptions options_;
  std::shared_ptr<const ScanMatcher> matcher_;
  std::deque<Local> locals_;
  MovingThings moving_;
  std::shared_ptr<const MatchReference> reference_;       // of locals_, in the frame of the newest of them
  std::unique_ptr<const grid::HitMissGrid> beams_;        // the same as a grid; made when it is needed
  std::unique_ptr<const grid::LikelihoodPyramid> walls_;  // the same as a pyramid; made when it is needed
  mrpt::math::TPose2D track_from_last_;
};

}  // namespace omnimapper::matching
