#include "front_end/Perception.h"

#include <algorithm>
#include <utility>

#include "front_end/DepthCloud.h"

namespace omnimapper::mapper {

using mrpt::obs::CObservation;

namespace {

bool isBrought(const std::vector<perception::DerivedName>& names, const std::vector<CObservation::ConstPtr>& brought) {
  return !names.empty() && std::all_of(names.begin(), names.end(), [&](const perception::DerivedName& name) {
    return std::any_of(brought.begin(), brought.end(), [&](const auto& observation) {
      return observation->sensorLabel == name.label && observation->GetRuntimeClass() == name.type;
    });
  });
}

}  // namespace

bool Perception::wants(const mrpt::obs::CObservation& raw) const {
  const auto takes = [&](const auto* part) { return part->wants(raw); };
  return std::any_of(extractors_.begin(), extractors_.end(), takes) ||
         std::any_of(plugins_.begin(), plugins_.end(), takes);
}

std::future<PerceivedParts> Perception::submit(CObservation::ConstPtr raw, std::vector<CObservation::ConstPtr> brought,
                                               perception::Blackboard board) const {
  return pool_.submit<PerceivedParts>(
      [this, raw = std::move(raw), brought = std::move(brought), board = std::move(board)]() mutable {
        PerceivedParts all;
        all.parts.push_back(prepared(raw, board));
        for (const auto* extractor : extractors_) {
          if (!extractor->wants(*raw)) continue;
          std::vector<CObservation::Ptr> made;
          try {
            if (!isBrought(extractor->namesOf(*raw), brought)) made = extractor->extractUsing(*raw, board);
          } catch (const base::Error& error) {
            all.errors.add(error, *raw);
          }
          for (const auto& derived : made) all.parts.push_back(prepared(derived, board));
        }
        all.cloud = depthCloud(*raw, cloud_, board);
        return all;
      });
}

Perceived Perception::prepared(mrpt::obs::CObservation::ConstPtr observation,
                               const perception::Blackboard& board) const {
  Perceived perceived{std::move(observation), {}};
  for (const auto* plugin : plugins_) {
    perceived.prepared.push_back(
        plugin->wants(*perceived.observation) ? plugin->prepareUsing(*perceived.observation, board) : nullptr);
  }
  return perceived;
}

}  // namespace omnimapper::mapper
