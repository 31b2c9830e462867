#pragma once

#include <omnimapper/perception/Normals.h>

#include <cstdint>

#include "../planes/InverseDepth.h"

namespace omnimapper::perception::edges {

struct CurvatureThresholds {
  double least = 0;        ///< [rad] smallest angle between the normals of the two sides
  double noise_at_1m = 0;  ///< [rad] smallest angle at 1 m that noise does not explain; it grows with the depth
  int max_gap = 0;         ///< [px] without normals, between two normals that are compared
  int min_pixels = 0;      ///< edges with fewer pixels are dropped
};

/// Adds kHighCurvature to the labels of an image's pixels (no padding); see EdgeDetector. The labels of depth
/// discontinuities must be there already, since no curvature edge may cross one.
void labelCurvatureEdges(const planes::InverseDepth& inverse, const camera::Pinhole& camera, const NormalImage& normals,
                         const CurvatureThresholds& thresholds, std::uint8_t* labels);

}  // namespace omnimapper::perception::edges
