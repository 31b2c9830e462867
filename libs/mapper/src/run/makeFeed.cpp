#include "run/Feed.h"
#include "run/LiveFeed.h"
#include "run/LogFeed.h"
#include "run/ReplayFeed.h"

namespace omnimapper::mapper {

std::unique_ptr<Feed> makeFeed(const RunRequest& request, const base::Config& config) {
  // Read in any case, so that its keys are checked.
  const auto source = config.section("source").read<source::SourceOptions>();
  const auto live = config.section("live").read<live::LiveOptions>();
  if (request.live) return std::make_unique<LiveFeed>(live, source.labels, config);
  if (!request.replay.empty()) return std::make_unique<ReplayFeed>(request.replay, config.text());
  return std::make_unique<LogFeed>(request.logs, request.speed, source);
}

}  // namespace omnimapper::mapper
