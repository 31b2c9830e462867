#pragma once

#include <omnimapper/plugin/Batch.h>
#include <omnimapper/plugin/View.h>

#include <string>

#include "PointLandmarkIndex.h"
#include "PointLandmarksPlugin.h"

namespace omnimapper::plugins {

/// Merges points without numbers that turn out to be one: they differ by no more than the map leaves open, and were
/// never seen at once.
mapper::Batch mergeAlike(const PointLandmarkIndex& known, const PointLandmarksOptions& options,
                         const std::string& section, const mapper::View& view);

}  // namespace omnimapper::plugins
