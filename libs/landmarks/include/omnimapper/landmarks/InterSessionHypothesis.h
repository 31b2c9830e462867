#pragma once

#include <omnimapper/plugin/Association.h>
#include <omnimapper/plugin/Batch.h>
#include <omnimapper/plugin/View.h>

namespace omnimapper::landmarks {

/// Where it is not known how the sessions of a key frame and of the landmark it saw lie to each other, adds the
/// measurement as a hypothesis for the consistency test, with its decision, and gives true: it would be the first thing
/// that ties its session to the map, and if it were wrong, everything would be.
bool addInterSessionHypothesis(const mapper::View& view, base::KeyFrameId frame, const mapper::Pairing& pairing,
                               mapper::Decision& decision, mapper::Batch& batch);

}  // namespace omnimapper::landmarks
