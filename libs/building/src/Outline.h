#pragma once

#include <omnimapper/building/Storey.h>

#include <opencv2/core.hpp>

#include "FreeSpace.h"

namespace omnimapper::building {

/// Sets outline, holes, centre and clearance of a room that consists of the cells of `mask` (CV_8U), whose upper left
/// corner is the working cell `corner`.
void outline(const FreeSpace& space, const geometry::Se2& map_from_grid, const cv::Mat& mask, const cv::Point& corner,
             Room& room);

}  // namespace omnimapper::building
