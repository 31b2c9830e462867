#pragma once

#include <omnimapper/plugin/Batch.h>
#include <omnimapper/plugin/PanTiltOffsets.h>
#include <omnimapper/plugin/View.h>

#include <string>
#include <vector>

#include "SignLandmarksOptions.h"
#include "SignMeasurement.h"
#include "SignTracks.h"
#include "Triangulation.h"

namespace omnimapper::plugins {

/// The record, with the plugin's section as owner and the landmark in its tags.
graph::FactorRecord ofLandmark(graph::FactorRecord record, base::LandmarkId landmark, const std::string& section);

/// Adds a new landmark at `place`, where the directions of the views meet, with the factors that bind the landmark to
/// the poses of these views.
void addSign(const std::vector<SignView>& views, const Triangulation& place, mapper::PanTiltOffsets& offsets,
             const SignLandmarksOptions& options, const std::string& section, mapper::Batch& batch);

/// At the end of a log, adds signs that were given up during mapping because their latest direction never met enough
/// other directions. Each sign is added where most of its directions meet, unless a sign with the same text is there
/// already.
void addUnplacedSigns(const SignTracks& tracks, mapper::PanTiltOffsets& offsets, const SignLandmarksOptions& options,
                      const std::string& section, const mapper::View& view, mapper::Batch& batch);

}  // namespace omnimapper::plugins
