#pragma once

#include <omnimapper/matching/ScanMatcher.h>
#include <omnimapper/plugin/Job.h>
#include <omnimapper/plugin/PluginFactory.h>

#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "LoopClosureOptions.h"

namespace omnimapper::plugins {

/// One search for loop closures, as a job: what the newest key frames saw is sought in local maps of places seen long
/// ago, as far around the estimate as it may be wrong (Olson 2009; Hess et al. 2016), and the best is matched finely.
class LoopSearch {
 public:
  /// What a key frame saw, in its base.
  struct KeyScan {
    base::KeyFrameId frame;
    std::shared_ptr<const matching::ScanWithNormals> scan;
    double travel;  // [m] driven until there
  };
  /// A place to try: the key frame it is about, and those before and after it that its local map is made of.
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

  /// A hypothesis for each place that matches, a decision for every one.
  mapper::Batch operator()(const mapper::State& state) const;

 private:
  /// How far off the newest key frame may be, seen from a place [m] [rad].
  struct SearchUncertainty {
    double position, yaw;
  };
  SearchUncertainty uncertaintyAt(const Place& place, const mapper::State& state) const;
  /// As much of what was seen as leaves no doubt where along a corridor it was: the more, the vaguer the
  /// estimate.
  matching::ScanWithNormals localMapOf(const Place& place, const SearchUncertainty& uncertainty,
                                       const mapper::State& state) const;
  matching::ScanWithNormals query(const SearchUncertainty& uncertainty, const mapper::State& state) const;
  double queryTravel(const SearchUncertainty& uncertainty) const;  // [m] back from the newest key frame
  /// What was found at a place.
  struct Attempt {
    const Place* place;
    mrpt::math::TPose2D guess;  // place_from_base by the estimate
    mapper::Decision decision;
    std::vector<matching::ScanMatch> matches;  // best first
  };
  /// None for a place that is passed over for what the estimate says.
  std::optional<Attempt> attemptAt(const Place& place, const mapper::State& state) const;
  static std::optional<double> overlapElsewhere(const std::vector<Attempt>& attempts, const Attempt& attempt,
                                                const mapper::State& state);
  std::vector<mrpt::math::TPose2D> starts(const matching::ScanWithNormals& local,
                                          const matching::ScanWithNormals& query, const mrpt::math::TPose2D& guess,
                                          const SearchUncertainty& uncertainty) const;

  LoopClosureOptions options_;
  mapper::PluginContext context_;
  std::shared_ptr<const matching::ScanMatcher> matcher_;
  std::vector<KeyScan> newest_;  // the newest last
  std::vector<Place> places_;
};

/// Note of the factors of closures that were found by a search of the whole map.
inline constexpr char kGlobalClosure[] = "global loop closure";

/// The scans of some key frames together, in the frame of `centre`, by the estimate in `state`.
matching::ScanWithNormals localMap(const std::vector<LoopSearch::KeyScan>& key_scans, base::KeyFrameId centre,
                                   const mapper::State& state);

/// Whether the best of `matches`, best first, is a closure, told in `decision`: enough overlap, walls that fix it, and
/// no other as good elsewhere. `guess`: where the estimate has it.
void judgeClosure(const LoopClosureOptions& options, const std::vector<matching::ScanMatch>& matches,
                  const mrpt::math::TPose2D& guess, mapper::Decision& decision);

}  // namespace omnimapper::plugins
