#pragma once

#include <omnimapper/mapper/MappingRun.h>
#include <omnimapper/mapper/SessionOptions.h>

#include <string>
#include <vector>

#include "run/Feed.h"

// The errors of runs that have no map to write. Each throws base::Error with what is missing and the remedy.
namespace omnimapper::mapper {

/// No observation became a key frame. An empty map is not written, because it would replace a good one.
[[noreturn]] void failWithNothingToMap(const Feed& feed, const std::string& ini, const RunResult& result,
                                       const std::vector<std::string>& unknown_labels,
                                       const std::string& missing_extractors);

/// Nothing measured the motion: all key frames would get the same pose.
[[noreturn]] void failWithNoMotion(const Feed& feed, const std::string& ini, const RunResult& result,
                                   const std::vector<std::string>& idle);

/// A run that localizes found no place in the map; the trajectory has been written, at the place of [session] start.
[[noreturn]] void failWithNoPlace(const RunRequest& request, const RunResult& result, SessionOptions::Start start);

/// A map is to be continued, and nothing could tie the log to it.
[[noreturn]] void failWithNoTie(const std::string& ini);

}  // namespace omnimapper::mapper
