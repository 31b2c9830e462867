#pragma once

#include <omnimapper/draw/Image.h>
#include <omnimapper/draw/Legend.h>
#include <omnimapper/obs/CObservationDoorSigns.h>

#include <vector>

namespace omnimapper::pictures {

/// Draws the outline of each sign on the image in which it was found, and below it its texts with their confidences:
/// green if one of them is certain (confidence 0.9 or more), else orange. Adds rows to `legend`.
void drawSigns(draw::Image& picture, const obs::CObservationDoorSigns& found, std::vector<draw::LegendRow>& legend);

}  // namespace omnimapper::pictures
