#include <omnimapper/mapper/SensorPoses.h>

#include "run/Feed.h"
#include "run/LiveFeed.h"
#include "run/LogFeed.h"
#include "run/ReplayFeed.h"

namespace omnimapper::mapper {

std::unique_ptr<Feed> makeFeed(const RunRequest& request, const base::Config& config) {
  // Read in any case, so that its keys are checked.
  const auto source = sourceOptions(config);
  const auto live = config.section("live").read<live::LiveOptions>();
  if ((request.live || !request.replay.empty()) && !source.clock_offsets.empty()) {
    throw base::Error(base::ExitCode::out_of_range,
                      config.placeOf("mapper", "sensors") + ": clock_offset_s of '" +
                          source.clock_offsets.begin()->first +
                          "' is for logs; for a live sensor set clock_offset_s in the section of its driver");
  }
  if (request.live) return std::make_unique<LiveFeed>(live, source.labels, config, request.changed_config);
  if (!request.replay.empty()) return std::make_unique<ReplayFeed>(request.replay, config.text());
  return std::make_unique<LogFeed>(request, source);
}

}  // namespace omnimapper::mapper
