#include "back_end/BatchApplier.h"

#include <omnimapper/plugin/StageTimes.h>

#include <algorithm>
#include <memory>
#include <utility>

namespace omnimapper::mapper {

void BatchApplier::apply(const Batch& batch, const BatchOrigin& origin, MeasurementPlugin& plugin) {
  const auto ids = mapper::apply(batch, origin, graph_, map_);
  decisions_.insert(decisions_.end(), batch.decisions().begin(), batch.decisions().end());
  estimator_.applied(batch, ids);
  plugin.applied(ids);
}

void BatchApplier::collectFollowUps(base::KeyFrameId id, const View& view, double& plugin_seconds) {
  std::shared_ptr<const Snapshot> snapshot;
  for (auto& [section, plugin] : plugins_) {
    const StopWatch watch;
    FollowUp follow_up = plugin->afterCommit(map_.keyFrame(id), view);
    plugin_seconds += watch.seconds();
    const BatchOrigin origin{section, map_.keyFrame(id).stamp};
    if (!follow_up.jobs.empty() && !snapshot) {
      snapshot = std::make_shared<const Snapshot>(Snapshot{map_, graph_, estimator_.uncertainty()});
    }
    for (auto& job : follow_up.jobs) jobs_.add(map_.key_frames.size(), origin, id, std::move(job), snapshot);
    if (!follow_up.batch.empty()) apply(follow_up.batch, origin, *plugin);
  }
}

void BatchApplier::applyJobs(bool all, double& waited) {
  for (;;) {
    const StopWatch watch;
    const auto done = jobs_.take(map_.key_frames.size(), all);
    waited += watch.seconds();
    if (!done) return;
    const std::string why_unfit = whyUnfit(done->batch, graph_, map_);
    if (why_unfit.empty()) {
      apply(done->batch, done->origin, pluginOf(done->origin.owner));
      continue;
    }
    Decision dropped;
    dropped.stamp = done->origin.stamp;
    dropped.plugin = done->origin.owner;
    dropped.kind = done->name;
    dropped.from = done->frame;
    dropped.reason = "what it is about has changed since: " + why_unfit;
    decisions_.push_back(std::move(dropped));
  }
}

MeasurementPlugin& BatchApplier::pluginOf(const std::string& section) const {
  return *std::find_if(plugins_.begin(), plugins_.end(), [&](const auto& named) {
            return named.section == section;
          })->plugin;
}

}  // namespace omnimapper::mapper
