#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ScanDatabase.h"

namespace omnimapper::plugins {

/// Matches the newest scans with the whole scan database, however wrong the estimate is: a global search
/// (matching::Relocalizer), then a fine match with the scans around the place that was found. Keeps references to the
/// arguments of its constructor.
class GlobalMatcher {
 public:
  /// `newest`: the scans of the newest key frames, from the clouds with the label `label`; the newest comes last.
  GlobalMatcher(const LoopClosureOptions& options, const matching::ScanMatcher& matcher, const ScanDatabase& places,
                const std::string& label, const std::vector<LoopSearch::KeyScan>& newest)
      : options_(options), matcher_(matcher), places_(places), label_(label), newest_(newest) {}

  struct Found {
    ScanDatabase::Place place;  ///< the one nearest to the answer of the search; the reference of the match
    matching::ScanMatch match;  ///< of the newest scans; its pose is that of the newest key frame
    bool is_distinct;           ///< few other places look alike
  };
  /// Writes the numbers of the search to `decision`. None if there is no single answer or the fine matcher does not
  /// confirm it; `decision` then has the reason.
  std::optional<Found> find(const mapper::State& state, mapper::Decision& decision) const;
  /// Whether `newest` covers a travel of at least join_travel and all its scans fit the map, given the pose that was
  /// found for the last of them; if not, `decision` says why. The check is needed because a corridor outside the map
  /// looks like a corridor of the map until its end is seen.
  bool fitsAlongTravel(const Found& found, const mapper::State& state, mapper::Decision& decision) const;

 private:
  std::vector<matching::LocalScan> beams(const mapper::State& state) const;
  matching::Location locate(const mapper::State& state, mapper::Decision& decision) const;

  const LoopClosureOptions& options_;
  const matching::ScanMatcher& matcher_;
  const ScanDatabase& places_;
  const std::string& label_;
  const std::vector<LoopSearch::KeyScan>& newest_;
};

}  // namespace omnimapper::plugins
