#pragma once

#include <omnimapper/mapper/MappingRun.h>

#include <functional>
#include <set>
#include <string>

#include "Engine.h"

namespace omnimapper::mapper {

/// Each function adds warnings to the engine: sentences that name a remedy, for the report and the summary.
void warnOfLog(const source::SourceReport& report, bool stopped, Engine& engine);
/// Observations that were left out; `key_frames` is the number of key frames of this run.
void warnOfCounts(const RunCounts& counts, std::size_t key_frames, Engine& engine);
/// Whether more than half of the observations were left out: the map would not represent the log.
bool isMostlyLeftOut(const RunCounts& counts);
/// Plugins that received no observations; and if no section of `measuring`, those that measure, made a factor.
/// `missing_for` returns what a section lacks, or an empty string.
void warnOfNothingMeasured(const std::set<std::string>& measuring,
                           const std::function<std::string(const std::string& section)>& missing_for, Engine& engine);
/// Sessions before the last that are not tied to the map.
void warnOfEarlierSessions(const std::vector<map::Session>& sessions, Engine& engine);
/// Whether the place of the session in an earlier map is unknown or uncertain.
void warnOfSession(const map::Session& session, bool stopped, Engine& engine);
/// How many key frames of a run that localizes were located.
void warnOfLocalization(const RunResult& result, Engine& engine);

}  // namespace omnimapper::mapper
