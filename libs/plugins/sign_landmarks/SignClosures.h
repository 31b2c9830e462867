#pragma once

#include <omnimapper/plugin/Batch.h>
#include <omnimapper/plugin/View.h>

#include <string>

#include "SignLandmarksOptions.h"
#include "SignTracks.h"

namespace omnimapper::plugins {

/// For each new sign, adds the hypothesis that it is the same as another sign if exactly one other sign has its text
/// and was not seen recently. If two others have the text, or if another sign with the text was recently seen at
/// another place, the signs are marked as repeated and no hypothesis is added.
mapper::Batch proposeSameSigns(SignTracks& tracks, const SignLandmarksOptions& options, const std::string& section,
                               const mapper::View& view);

/// Merges signs that are the same: either the hypothesis was accepted, or their texts agree and their positions agree
/// within the map's uncertainty and to 1 m (0.25 m if the texts agree only partly or one may be misread).
mapper::Batch mergeSameSigns(const SignTracks& tracks, const SignLandmarksOptions& options, const std::string& section,
                             const mapper::View& view);

}  // namespace omnimapper::plugins
