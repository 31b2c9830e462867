#include <omnimapper/plugins/LoopSearch.h>

#include "ScanFactor.h"

namespace omnimapper::plugins {

matching::PlanarScan localMap(const std::vector<LoopSearch::Sight>& sights, base::KeyFrameId centre,
                              const mapper::State& state) {
  const auto& map_from_centre = state.map.keyFrame(centre).map_from_base;
  matching::PlanarScan local;
  for (const auto& sight : sights) {
    matching::append(*sight.scan, planar(state.map.keyFrame(sight.frame).map_from_base - map_from_centre), local);
  }
  return local;
}

mapper::Batch LoopSearch::operator()(const mapper::State& state) const {
  mapper::Batch batch;
  for (const auto& place : places_) tryPlace(place, state, batch);
  return batch;
}

void LoopSearch::tryPlace(const Place& place, const mapper::State& state, mapper::Batch& batch) const {
  const auto& frame = state.map.keyFrame(newest_.frame);
  const auto& centre = state.map.keyFrame(place.centre);
  const auto guess = planar(frame.map_from_base - centre.map_from_base);
  const auto reference = matcher_->prepare(localMap(place.around, place.centre, state));
  const auto match = matcher_->match(*reference, *newest_.scan, {guess});
  auto decision =
      judge(match, guess, {options_.loop_min_overlap, options_.loop_max_correction, options_.loop_max_turn_correction});
  decision.stamp = frame.stamp;
  decision.plugin = context_.section;
  decision.kind = "loop closure";
  decision.from = frame.id;
  decision.to = centre.id;
  if (!decision.accepted) return batch.log(std::move(decision));
  auto closure = scanFactor(options_, options_.loop_position_sigma_floor, options_.loop_angle_sigma_floor, context_,
                            centre.pose, frame.pose, match);
  closure.loss = graph::Loss::cauchy(options_.loop_loss_scale);
  batch.addHypothesis(std::move(closure), std::move(decision));
}

}  // namespace omnimapper::plugins
