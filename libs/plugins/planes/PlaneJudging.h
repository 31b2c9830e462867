#pragma once

#include <omnimapper/plugin/View.h>

#include <map>
#include <memory>

#include "PlaneLandmarkIndex.h"

namespace omnimapper::plugins {

/// The payloads of plane landmarks, by landmark.
using PlanePayloads = std::map<base::LandmarkId, std::shared_ptr<const PlanePayload>>;

/// The payloads with the class of each surface among all others (surfaces::classify()), and whether it was measured
/// often and well enough to be drawn. Landmarks that only laser lines measured are walls, drawn if measured three
/// times.
PlanePayloads judged(const PlanePayloads& payloads, const PlaneLandmarkIndex& known, const mapper::View& view);

}  // namespace omnimapper::plugins
