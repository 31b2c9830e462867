#pragma once

#include <omnimapper/plugin/Batch.h>
#include <omnimapper/plugin/View.h>

#include <string>

#include "KnownPoint.h"
#include "PointLandmarksOptions.h"

namespace omnimapper::plugins {

/// Merges landmarks without numbers that are the same point: their positions agree within the map's uncertainty, and
/// they were never seen at the same time.
mapper::Batch mergeAlike(const PointLandmarkIndex& known, const PointLandmarksOptions& options,
                         const std::string& section, const mapper::View& view);

}  // namespace omnimapper::plugins
