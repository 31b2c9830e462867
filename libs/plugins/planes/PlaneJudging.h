#pragma once

#include <omnimapper/plugin/View.h>

#include <map>
#include <memory>

#include "PlaneLandmarkIndex.h"

namespace omnimapper::plugins {

/// The payloads of plane landmarks, by landmark.
using PlanePayloads = std::map<base::LandmarkId, std::shared_ptr<const PlanePayload>>;

/// The payloads, completed by the class of each surface among all others (surfaces::classify()) and by whether the
/// surface was measured often and well enough to be drawn. Landmarks that only laser lines measured are walls, which
/// are drawn if they were measured at least three times, where something stands along them (LineSupport).
PlanePayloads judged(const PlanePayloads& payloads, const PlaneLandmarkIndex& known, const mapper::View& view);

}  // namespace omnimapper::plugins
