#pragma once

#include <omnimapper/graph/FactorRecord.h>
#include <omnimapper/matching/ScanMatcher.h>
#include <omnimapper/plugin/PluginFactory.h>

#include "LoopClosureOptions.h"
#include "PlanarMotion.h"

namespace omnimapper::plugins {

/// The motion between two poses that a match measured. In a spatial map height and tilt stay open.
graph::FactorRecord scanFactor(const LoopClosureOptions& options, const mapper::PluginContext& context,
                               base::VariableId reference, base::VariableId scan, const matching::ScanMatch& match);

/// That motion, of `scan` from `reference`. Height and tilt are open.
mapper::RelativeMotion scanMotion(const LoopClosureOptions& options, const matching::ScanMatch& match);

}  // namespace omnimapper::plugins
