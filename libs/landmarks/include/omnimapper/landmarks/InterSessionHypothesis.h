#pragma once

#include <omnimapper/plugin/Association.h>
#include <omnimapper/plugin/Batch.h>
#include <omnimapper/plugin/View.h>

namespace omnimapper::landmarks {

/// If the relative pose of the sessions of the key frame and of the landmark is unknown, adds the measurement as a
/// hypothesis for the consistency test, with its decision, and returns true. The measurement would be the first to tie
/// its session to the map, and a wrong one would displace the whole session.
bool addInterSessionHypothesis(const mapper::View& view, base::KeyFrameId frame, const mapper::Pairing& pairing,
                               mapper::Decision& decision, mapper::Batch& batch);

}  // namespace omnimapper::landmarks
