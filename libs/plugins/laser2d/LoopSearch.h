#pragma once

#include <omnimapper/matching/ScanMatcher.h>
#include <omnimapper/plugin/Job.h>
#include <omnimapper/plugin/PluginFactory.h>

#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "LoopClosureOptions.h"

namespace omnimapper::plugins {

class ScanDatabase;

/// A job that searches for loop closures: it matches the newest scans with local maps of places seen long ago, in
/// windows as large as the uncertainty of the estimate (Olson 2009; Hess et al. 2016), and refines the best matches.
class LoopSearch {
 public:
  /// The scan of a key frame, in the frame of its base.
  struct KeyScan {
    base::KeyFrameId frame;
    std::shared_ptr<const matching::ScanWithNormals> scan;
    double travel;  // [m] travelled until there
  };
  /// A place to try: its key frame, and the scans before and after it from which its local map is made.
  struct Place {
    KeyScan centre;
    std::vector<KeyScan> around;
  };

  LoopSearch(const LoopClosureOptions& options, const mapper::PluginContext& context,
             std::shared_ptr<const matching::ScanMatcher> matcher, std::vector<KeyScan> newest,
             std::vector<Place> places)
      : options_(options),
        context_(context),
        matcher_(std::move(matcher)),
        newest_(std::move(newest)),
        places_(std::move(places)) {}

  /// Places of another session than the newest scans become closures only if the scans of the session fit the map
  /// there, from `saved` (SessionCheck.h). `label`: of the clouds.
  void testSessionsWith(std::shared_ptr<const ScanDatabase> saved, std::string label) {
    saved_ = std::move(saved);
    label_ = std::move(label);
  }

  /// Sets the distance travelled [m] at the newest gap across which the base may have been carried.
  void setBroken(double travel) { broken_ = travel; }

  /// A hypothesis for each place that matches, and a decision for each place that was tried.
  mapper::Batch operator()(const mapper::State& state) const;

 private:
  /// Uncertainty of the newest key frame relative to a place: three standard deviations [m] [rad].
  struct SearchUncertainty {
    double position, yaw;
  };
  SearchUncertainty uncertaintyAt(const Place& place, const mapper::State& state) const;
  /// The local map of a place, and the scans to match with it. The less certain the estimate is, the longer both are,
  /// so that they determine the position along a corridor, too.
  matching::ScanWithNormals localMapOf(const Place& place, const SearchUncertainty& uncertainty,
                                       const mapper::State& state) const;
  matching::ScanWithNormals query(const SearchUncertainty& uncertainty, const mapper::State& state) const;
  double queryTravel(const SearchUncertainty& uncertainty) const;  // [m] back from the newest key frame
  /// The matches at a place.
  struct Attempt {
    const Place* place;
    mrpt::math::TPose2D guess;  // place_from_base by the estimate
    mapper::Decision decision;
    std::vector<matching::ScanMatch> matches;  // best first
  };
  /// None if, by the estimate, the place is out of reach or a closure would add no information.
  std::optional<Attempt> attemptAt(const Place& place, const mapper::State& state) const;
  LoopClosureOptions optionsFor(const Attempt& attempt) const;
  static bool isNearEstimate(const Attempt& attempt);
  // Whether the base may have been carried between the place and now.
  bool isAcrossBreak(const Place& place) const;
  bool confirmsAcrossBreak(const Attempt& attempt, const mapper::State& state, mapper::Decision& decision) const;
  bool confirmsSession(const Attempt& attempt, const mapper::State& state, mapper::Decision& decision) const;
  static std::optional<double> overlapElsewhere(const std::vector<Attempt>& attempts, const Attempt& attempt,
                                                const mapper::State& state);
  std::vector<mrpt::math::TPose2D> starts(const matching::ScanWithNormals& local,
                                          const matching::ScanWithNormals& query, const mrpt::math::TPose2D& guess,
                                          const SearchUncertainty& uncertainty, bool is_across_break) const;

  LoopClosureOptions options_;
  mapper::PluginContext context_;
  std::shared_ptr<const matching::ScanMatcher> matcher_;
  std::vector<KeyScan> newest_;  // the newest last
  std::vector<Place> places_;
  std::shared_ptr<const ScanDatabase> saved_;  // null if no map is continued
  std::string label_;
  double broken_ = -std::numeric_limits<double>::infinity();  // [m] travelled when the base may have been carried
};

/// The note that marks the factors of closures found by a search of the whole map.
inline constexpr char kGlobalClosure[] = "global loop closure";

/// Joins the scans of key frames, in the frame of `centre`, at their poses in `state`.
matching::ScanWithNormals localMap(const std::vector<LoopSearch::KeyScan>& key_scans, base::KeyFrameId centre,
                                   const mapper::State& state);

/// Writes to `decision` whether the best match is accepted as a closure: the match needs enough overlap, walls that
/// constrain the pose in all directions, and no equally good match elsewhere. `matches`: best first. `guess`: the
/// estimated pose.
void judgeClosure(const LoopClosureOptions& options, const std::vector<matching::ScanMatch>& matches,
                  const mrpt::math::TPose2D& guess, mapper::Decision& decision);

}  // namespace omnimapper::plugins
