#pragma once

#include <omnimapper/camera/DepthImage.h>

#include <limits>
#include <vector>

namespace omnimapper::perception {

/// Points in the order of an image's pixels, row by row, in the sensor's optical frame [m]: x right, y down, z forward.
/// NaN where nothing was measured.
struct OrganizedPoints {
  int width = 0, height = 0;
  std::vector<float> x, y, z;
};

/// Computes the points of a depth image. Depths outside [min_depth, max_depth] [m] count as not measured.
OrganizedPoints backProject(const camera::DepthImage& image, double min_depth = 0,
                            double max_depth = std::numeric_limits<double>::infinity());

}  // namespace omnimapper::perception
