#pragma once

#include <omnimapper/perception/Normals.h>

#include <cstdint>

#include "../planes/InverseDepth.h"

namespace omnimapper::perception::edges {

struct CreaseThresholds {
  double least = 0;        ///< [rad]
  double noise_at_1m = 0;  ///< [rad] least angle at 1 m for the noise alone; it grows with the depth
  int max_gap = 0;         ///< [px] without normals, between two that are compared
  int min_pixels = 0;      ///< of an edge
};

/// Adds kHighCurvature to the labels of an image's pixels, which have those of jumps already; see EdgeDetector.
void markCreases(const planes::InverseDepth& inverse, const Pinhole& camera, const NormalImage& normals,
                 const CreaseThresholds& thresholds, std::uint8_t* labels);

}  // namespace omnimapper::perception::edges
