#pragma once

#include <omnimapper/graph/FactorRecord.h>
#include <omnimapper/matching/ScanMatcher.h>
#include <omnimapper/plugin/PluginFactory.h>

#include "LoopClosureOptions.h"
#include "PlanarMotion.h"

namespace omnimapper::plugins {

/// Factor for the relative pose that a scan match measured. Height and tilt of a spatial map stay nearly unconstrained.
graph::FactorRecord scanFactor(const LoopClosureOptions& options, const mapper::PluginContext& context,
                               base::VariableId reference, base::VariableId scan, const matching::ScanMatch& match);

/// The relative pose that a scan match measured, with wide variances of height and tilt.
mapper::RelativeMotion scanMotion(const LoopClosureOptions& options, const matching::ScanMatch& match);

}  // namespace omnimapper::plugins
