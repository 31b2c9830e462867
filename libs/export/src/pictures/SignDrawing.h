#pragma once

#include <omnimapper/draw/Image.h>
#include <omnimapper/obs/CObservationDoorSigns.h>

#include <vector>

#include "pictures/Legend.h"

namespace omnimapper::exports {

/// Draws the outline of each sign on the image in which it was found, and below it its texts with how likely each is
/// right: green where one of them is sure (0.9), orange where none is. Adds what that means to `legend`.
void drawSigns(draw::Image& picture, const obs::CObservationDoorSigns& found, std::vector<LegendRow>& legend);

}  // namespace omnimapper::exports
