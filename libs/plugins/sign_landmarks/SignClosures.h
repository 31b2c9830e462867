#pragma once

#include <omnimapper/plugin/Batch.h>
#include <omnimapper/plugin/View.h>

#include <string>

#include "SignLandmarksPlugin.h"
#include "SignTracks.h"

namespace omnimapper::plugins {

/// Of each sign that is new: if another one, that was not seen just now, has the same text, that both are one is a
/// hypothesis. Where two others have it, or the same text is seen at another place at the same time, it is noted that
/// the text is repeated, and nothing is proposed.
mapper::Batch proposeSameSigns(SignTracks& tracks, const SignLandmarksOptions& options, const std::string& section,
                               const mapper::View& view);

/// Merges what turned out to be one: by a hypothesis that was accepted, or because their texts agree and their places
/// differ by no more than the map leaves open and a metre.
mapper::Batch mergeSameSigns(const SignTracks& tracks, const SignLandmarksOptions& options, const std::string& section,
                             const mapper::View& view);

}  // namespace omnimapper::plugins
