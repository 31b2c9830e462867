#pragma once

#include <omnimapper/base/OptionTable.h>
#include <omnimapper/grid/BeamScan.h>
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
  int local_scans = 40;                                              ///< that make the local map
  double local_distance = 0.25;                                      ///< [m] between them
  double local_angle = 10.0 * base::option_text::kRadiansPerDegree;  ///< [rad] between them
  double min_overlap = 0.4;                                          ///< share of the points that must find a partner
  double max_correction = 0.5;                                       ///< [m] of a prediction by the match
  double max_turn_correction = 20 * base::option_text::kRadiansPerDegree;  ///< [rad]

  static const base::OptionTable<ScanTrackerOptions>& table();
};

/// The motion since the last scan as some source predicts it.
struct MotionPrediction {
  MatchGuess guess;
  /// How far off it may be, one standard deviation [m] [rad]: by what its source was off of late.
  double position_sigma = 1, angle_sigma = 1;
  /// How far off it can be at all [m] [rad]: as much as a base can accelerate meanwhile.
  double most_position = std::numeric_limits<double>::infinity(), most_angle = most_position;
  /// Whether nothing tells the motion, as across a gap: the scan is searched up to 3 m around, at all headings, and
  /// must fit by itself.
  bool is_blind = false;
};

/// Follows a laser from scan to scan: each is matched against a local map of some before it, so that what one scan errs
/// the next does not carry on. Poses are of the frame that the scans are in.
///
/// The most trusted prediction leads to a match. Every other prediction that would not have led there is tried too, and
/// where one leads to none it stands for itself. Of several that is taken which is most probable by the walls and the
/// free space of the local map and by all predictions together (Olson 2009; Thrun, Burgard and Fox 2005, 6.3); if that
/// is no match, there is none.
class ScanTracker {
 public:
  ScanTracker(const ScanTrackerOptions& options, std::shared_ptr<const ScanMatcher> matcher);
  ~ScanTracker();
  ScanTracker(ScanTracker&&) noexcept;
  ScanTracker& operator=(ScanTracker&&) noexcept;

  /// Forgets all scans; this one is the first. `sensor`: where its laser stood, in its frame [m].
  void restart(const ScanWithNormals& scan, const Eigen::Vector2f& sensor);
  struct Tracked {
    ScanMatch match;  ///< of the motion since the last scan; covariance and all are of the scan in the local map
    std::size_t prediction = 0;  ///< that led to it
    /// What other matches that were found, less probable ones, add to the covariance, in the scan's frame: x y yaw [m]
    /// [rad].
    Eigen::Matrix3d search_covariance = Eigen::Matrix3d::Zero();
  };
  /// Matches a scan and takes it for the last one. `predictions`: that most trusted first. None, and nothing changes,
  /// if none leads to a match, or what is more probable than the match is none.
  std::optional<Tracked> track(const ScanWithNormals& scan, const Eigen::Vector2f& sensor,
                               const std::vector<MotionPrediction>& predictions);

 private:
  struct Local {
    mrpt::math::TPose2D track_from_scan;
    ScanWithNormals scan;
    Eigen::Vector2f sensor;
  };
  struct Candidates;
  std::vector<Tracked> matchesOf(const ScanWithNormals& scan, const std::vector<MotionPrediction>& predictions,
                                 const mrpt::math::TPose2D& local_from_last) const;
  void search(Candidates& candidates);
  static void addPredictions(Candidates& candidates);
  void weigh(Candidates& candidates);
  static Tracked mostProbable(const Candidates& candidates);
  void remember(const ScanWithNormals& scan, const Eigen::Vector2f& sensor);
  ScanWithNormals localMap() const;
  const grid::HitMissGrid& beams();

  ScanTrackerOptions options_;
  std::shared_ptr<const ScanMatcher> matcher_;
  std::deque<Local> locals_;
  std::shared_ptr<const MatchReference> reference_;       // of locals_, in the frame of the newest of them
  std::unique_ptr<const grid::HitMissGrid> beams_;        // the same, once somebody has asked for it
  std::unique_ptr<const grid::LikelihoodPyramid> walls_;  // and again
  mrpt::math::TPose2D track_from_last_;
};

}  // namespace omnimapper::matching
