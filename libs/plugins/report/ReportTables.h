#pragma once

#include <omnimapper/derived/RunMetrics.h>
#include <omnimapper/plugin/View.h>

#include <string>

namespace omnimapper::plugins {

/// Distance travelled by each session and where it was aligned; empty for a map with one session.
std::string drawSessionTable(const map::Map& map);
/// Stamp of the first key frame of the newest session, from which the times of the log are counted; no stamp for an
/// empty map.
base::Stamp startOf(const map::Map& map);
/// Counts of decisions by plugin, kind, verdict and reason.
std::string drawReasonTable(const mapper::DecisionLog& decisions);
/// The decision log with filters and at most `max_rows` rows; if it is longer, refusals and closures are listed first.
std::string drawDecisionTable(const map::Map& map, const mapper::DecisionLog& decisions, std::size_t max_rows);
/// Counts of the observations by their use, and of the variables and factors in the graph.
std::string drawCountTables(const mapper::View& view);

}  // namespace omnimapper::plugins
