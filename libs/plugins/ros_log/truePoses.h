#pragma once

#include <omnimapper/source/ObservationSource.h>

#include "Plan.h"

namespace omnimapper::ros {

/// The poses of a topic in the order of their stamps. Reads the whole log, and rewinds the reader.
source::TruePoses truePosesOf(const std::string& topic, MessageReader& reader, const Channels& channels,
                              ChannelDecoder& decoder, const Plan& plan);

/// The pose at a time, interpolated between two that are at most 0.2 s apart; none elsewhere.
std::optional<geometry::Se3> poseAt(const source::TruePoses& poses, base::Stamp stamp);

}  // namespace omnimapper::ros
