#pragma once

#include <omnimapper/mapper/MappingRun.h>

#include <functional>
#include <set>
#include <string>

#include "Engine.h"

namespace omnimapper::mapper {

/// Each tells the engine what whoever reads the map should know of the run, in sentences that name a remedy: the report
/// and the summary show them.
void warnOfLog(const source::SourceReport& report, bool stopped, Engine& engine);
/// What was left out of what came; `key_frames` are those of this run.
void warnOfCounts(const RunCounts& counts, std::size_t key_frames, Engine& engine);
/// Whether more than half of what came was left out: a map of the rest would pass for one of the log.
bool isMostlyLeftOut(const RunCounts& counts);
/// Plugins that nothing came to; and if `measuring`, the sections that measure, made nothing of anything at all.
/// `missing_for` gives what a section lacks, or nothing.
void warnOfNothingMeasured(const std::set<std::string>& measuring,
                           const std::function<std::string(const std::string& section)>& missing_for, Engine& engine);
/// Of sessions before the last that nothing ties to the map.
void warnOfEarlierSessions(const std::vector<map::Session>& sessions, Engine& engine);
/// The place of a session in a map that was there before: known by nothing, or in doubt.
void warnOfSession(const map::Session& session, bool stopped, Engine& engine);
/// How much of a run that localizes was located.
void warnOfLocalization(const RunResult& result, Engine& engine);

}  // namespace omnimapper::mapper
