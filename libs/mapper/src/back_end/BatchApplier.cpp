#include "back_end/BatchApplier.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>

namespace omnimapper::mapper {

void BatchApplier::apply(const Batch& batch, const BatchOrigin& origin, MeasurementPlugin& plugin) {
  const auto ids = mapper::apply(batch, origin, state_.graph, state_.map);
  state_.decisions.insert(state_.decisions.end(), batch.decisions().begin(), batch.decisions().end());
  estimator_.applied(batch, ids);
  plugin.applied(ids);
}

void BatchApplier::collectFollowUps(base::KeyFrameId id) {
  std::shared_ptr<const Snapshot> snapshot;
  for (auto& named : plugins_) {
    const map::KeyFrame& frame = state_.map.keyFrame(id);
    const auto asked = [&] {
      const auto timer = state_.times.measure(Stage::plugin, named.section);
      return named.plugin->afterCommit(frame, state_.view());
    };
    FollowUp follow_up = asked();
    const BatchOrigin origin{named.section, frame.stamp};
    if (!follow_up.jobs.empty() && !snapshot)
      snapshot = std::make_shared<const Snapshot>(Snapshot{state_.map, state_.graph, state_.uncertainty});
    for (auto& job : follow_up.jobs) jobs_.add(state_.map.key_frames.size(), origin, id, std::move(job), snapshot);
    if (!follow_up.batch.empty()) apply(follow_up.batch, origin, *named.plugin);
  }
}

void BatchApplier::applyJobs(Which which) {
  const auto next = [&]() -> std::optional<JobQueue::Done> {
    const auto timer = state_.times.measure(Stage::job_wait);
    const std::size_t now = state_.map.key_frames.size();
    const bool takes =
        jobs_.size() > 0 && (which == Which::all || schedule_.takesJob(jobs_.isDue(now), jobs_.isDone()));
    return takes ? jobs_.take(now, true) : std::nullopt;
  };
  while (const auto done = next()) {
    const std::string why_unfit = whyUnfit(done->batch, state_.graph, state_.map);
    if (why_unfit.empty()) {
      apply(done->batch, done->origin, pluginOf(done->origin.owner));
      continue;
    }
    Decision dropped;
    dropped.stamp = done->origin.stamp;
    dropped.plugin = done->origin.owner;
    dropped.kind = done->name;
    dropped.from = done->frame;
    dropped.reason = "the graph or the map has changed since the job started: " + why_unfit;
    state_.decisions.push_back(std::move(dropped));
  }
}

MeasurementPlugin& BatchApplier::pluginOf(const std::string& section) const {
  return *std::find_if(plugins_.begin(), plugins_.end(), [&](const auto& named) {
            return named.section == section;
          })->plugin;
}

}  // namespace omnimapper::mapper
