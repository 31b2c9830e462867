#pragma once

#include <omnimapper/plugin/Batch.h>
#include <omnimapper/plugin/View.h>

#include <optional>
#include <string>

#include "PlaneLandmarkIndex.h"
#include "PlaneLandmarksPlugin.h"

namespace omnimapper::plugins {

/// Merges landmarks that turn out to be one: they overlap, and their planes differ by no more than the map leaves open;
/// or what was seen of them as planes lies on each other, whatever the covariance says.
mapper::Batch mergeAlike(PlaneLandmarkIndex& known, const PlaneLandmarksOptions& options, const std::string& section,
                         const mapper::View& view);

/// The same at the end of a run, and what each surface is in the whole map.
mapper::Batch mergeAndJudge(PlaneLandmarkIndex& known, const PlaneLandmarksOptions& options, const std::string& section,
                            const mapper::View& view);

/// Whether two surfaces lie on one plane, as far as anybody can see: whatever the covariance allows, what is farther
/// apart than 10 deg and 0.15 m looks like two.
bool onOnePlane(const PlaneLandmarkIndex::Surface& a, const PlaneLandmarkIndex::Surface& b);

/// The factor that holds a plane upright, if there is one.
std::optional<base::FactorId> uprightFactor(const graph::Graph& graph, base::VariableId plane);

}  // namespace omnimapper::plugins
