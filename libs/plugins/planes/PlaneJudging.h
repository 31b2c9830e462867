#pragma once

#include <omnimapper/plugin/View.h>

#include <map>
#include <memory>

#include "PlaneLandmarkIndex.h"

namespace omnimapper::plugins {

/// What is known of plane landmarks, by landmark.
using PlanePayloads = std::map<base::LandmarkId, std::shared_ptr<const PlanePayload>>;

/// The payloads of landmarks of a map, with what each surface is in the midst of the others (surfaces::classify()), and
/// whether it was seen often and well enough to be drawn. Lines of a laser alone are walls, and drawn if seen three
/// times.
PlanePayloads judged(const PlanePayloads& payloads, const PlaneLandmarkIndex& known, const mapper::View& view);

}  // namespace omnimapper::plugins
