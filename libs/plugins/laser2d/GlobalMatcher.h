#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ScanDatabase.h"

namespace omnimapper::plugins {

/// Matches the newest scans of a drive with all of the known places, however far the estimate is off: a global search
/// (matching::Relocalizer), then the fine matcher on the scans around the answer. Refers to its arguments.
class GlobalMatcher {
 public:
  /// `newest`: the newest last, of clouds of `label`.
  GlobalMatcher(const LoopClosureOptions& options, const matching::ScanMatcher& matcher, const ScanDatabase& places,
                const std::string& label, const std::vector<LoopSearch::KeyScan>& newest)
      : options_(options), matcher_(matcher), places_(places), label_(label), newest_(newest) {}

  struct Found {
    ScanDatabase::Place place;  ///< the nearest to the answer, which is the reference of the match
    matching::ScanMatch match;  ///< of the newest key frame
    bool is_distinct;           ///< only few other places look alike
  };
  /// None, with the reason and all numbers in `decision`, if there is no single answer that the fine matcher confirms.
  std::optional<Found> find(const mapper::State& state, mapper::Decision& decision) const;
  /// Whether the scans of all the distance travelled in `newest` fit the map, given where that puts the newest; else
  /// `decision` says why. A corridor that the map has not got looks like one that it has, until its end.
  bool fitsAllTheWay(const Found& found, const mapper::State& state, mapper::Decision& decision) const;

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
