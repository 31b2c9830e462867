#pragma once

#include <omnimapper/camera/RgbdView.h>
#include <omnimapper/obs/CObservationObjects.h>

#include <optional>
#include <vector>

#include "ObjectPayload.h"

namespace omnimapper::plugins {

/// A picture of each object of an observation, in its order: only the pixels of the object itself, so that nobody who
/// stands beside it is on it; all other pixels are light grey. Large pictures are reduced to at most 96 pixels on each
/// side. None where there is no colour or the object has hardly any pixel. `view`: the image in which the objects were
/// found.
std::vector<std::optional<ObjectPicture>> picturesOf(const obs::CObservationObjects& objects,
                                                     const camera::RgbdView& view);

}  // namespace omnimapper::plugins
