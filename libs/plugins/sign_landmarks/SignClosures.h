#pragma once

#include <omnimapper/plugin/Batch.h>
#include <omnimapper/plugin/View.h>

#include <string>

#include "SignLandmarksPlugin.h"
#include "SignTracks.h"

namespace omnimapper::plugins {

/// Adds a hypothesis for each new sign that is the same as an older one: exactly one other sign has its text, and that
/// was not seen recently. If two others have the text, or the same text is seen recently at another place, the signs
/// are marked as repeated and no hypothesis is added.
mapper::Batch proposeSameSigns(SignTracks& tracks, const SignLandmarksOptions& options, const std::string& section,
                               const mapper::View& view);

/// Merges signs that are the same: a hypothesis says so and was accepted, or their texts agree and their positions
/// differ by less than 1 m and less than the gate of the map's uncertainty.
mapper::Batch mergeSameSigns(const SignTracks& tracks, const SignLandmarksOptions& options, const std::string& section,
                             const mapper::View& view);

}  // namespace omnimapper::plugins
