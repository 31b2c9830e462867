#pragma once

#include <omnimapper/plugin/View.h>

#include <string>

#include "run/RunMetrics.h"

namespace omnimapper::exports {

/// How much each session drove and where it was joined; empty for a map of one session.
std::string drawSessionTable(const map::Map& map);
/// When the newest session, whose log is told, began; no stamp for an empty map.
base::Stamp startOf(const map::Map& map);
/// Counts of decisions by plugin, kind, verdict and reason.
std::string drawReasonTable(const mapper::DecisionLog& decisions);
/// The decision log with filters, at most `max_rows` rows: where it is longer, refusals and closures go first.
std::string drawDecisionTable(const map::Map& map, const mapper::DecisionLog& decisions, std::size_t max_rows);
/// What became of the observations, and what the graph holds.
std::string drawCountTables(const mapper::View& view);

}  // namespace omnimapper::exports
