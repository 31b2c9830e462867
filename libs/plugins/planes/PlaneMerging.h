#pragma once

#include <omnimapper/plugin/Batch.h>
#include <omnimapper/plugin/View.h>

#include <optional>
#include <string>

#include "PlaneLandmarkIndex.h"
#include "PlaneLandmarksOptions.h"

namespace omnimapper::plugins {

/// Merges landmarks that turn out to be one surface. Either they overlap, and their planes differ by no more than the
/// covariance of the map allows; or their measured parts cover each other, whatever the covariance is.
mapper::Batch mergeAlike(const PlaneLandmarkIndex& known, const PlaneLandmarksOptions& options,
                         const std::string& section, const mapper::View& view);

/// As mergeAlike(), but for the end of a run: also merges parts of one wall, and classifies each surface among all
/// surfaces of the map.
mapper::Batch mergeAndJudge(const PlaneLandmarkIndex& known, const PlaneLandmarksOptions& options,
                            const std::string& section, const mapper::View& view);

/// Whether two surfaces lie on one plane within 10 deg and 0.15 m. If they differ more, they are taken for two
/// surfaces, whatever the covariance allows.
bool onOnePlane(const LandmarkSurface& a, const LandmarkSurface& b);

/// The factor that holds a plane upright, if there is one.
std::optional<base::FactorId> uprightFactor(const graph::Graph& graph, base::VariableId plane);

}  // namespace omnimapper::plugins
