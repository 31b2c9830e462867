#pragma once

#include <omnimapper/plugin/Association.h>
#include <omnimapper/plugin/Batch.h>
#include <omnimapper/plugin/View.h>

namespace omnimapper::landmarks {

/// Returns false if the relative pose of the key frame's session and the landmark's session is known. Otherwise it adds
/// the measurement as a hypothesis for the consistency test, with its decision, and returns true: the measurement would
/// be the first to tie its session to the map, and a wrong measurement would displace the whole session.
bool addInterSessionHypothesis(const mapper::View& view, base::KeyFrameId frame, const mapper::Pairing& pairing,
                               mapper::Decision& decision, mapper::Batch& batch);

}  // namespace omnimapper::landmarks
