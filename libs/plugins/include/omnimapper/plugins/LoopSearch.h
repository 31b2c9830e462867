#pragma once

#include <omnimapper/mapper/Job.h>
#include <omnimapper/mapper/PluginFactory.h>
#include <omnimapper/matching/ScanMatcher.h>
#include <omnimapper/plugins/ScanMatchingOptions.h>

#include <memory>
#include <utility>
#include <vector>

namespace omnimapper::plugins {

/// One search for loop closures, as a job: a key frame's scan is matched against local maps of places seen long ago.
class LoopSearch {
 public:
  /// What a key frame saw, in its base.
  struct Sight {
    base::KeyFrameId frame;
    std::shared_ptr<const matching::PlanarScan> scan;
  };
  /// A place to try: the key frame it is about, and those around it that make its local map.
  struct Place {
    base::KeyFrameId centre;
    std::vector<Sight> around;
  };

  LoopSearch(const ScanMatchingOptions& options, const mapper::PluginContext& context,
             std::shared_ptr<const matching::ScanMatcher> matcher, Sight newest, std::vector<Place> places)
      : options_(options),
        context_(context),
        matcher_(std::move(matcher)),
        newest_(std::move(newest)),
        places_(std::move(places)) {}

  /// A hypothesis for each place that matches, a decision for every one.
  mapper::Batch operator()(const mapper::State& state) const;

 private:
  void tryPlace(const Place& place, const mapper::State& state, mapper::Batch& batch) const;

  ScanMatchingOptions options_;
  mapper::PluginContext context_;
  std::shared_ptr<const matching::ScanMatcher> matcher_;
  Sight newest_;
  std::vector<Place> places_;
};

/// The scans of some key frames together, in the frame of `centre`, by the estimate in `state`.
matching::PlanarScan localMap(const std::vector<LoopSearch::Sight>& sights, base::KeyFrameId centre,
                              const mapper::State& state);

}  // namespace omnimapper::plugins
