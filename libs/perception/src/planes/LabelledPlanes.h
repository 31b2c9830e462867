#pragma once

#include <omnimapper/camera/DepthImage.h>
#include <omnimapper/perception/PlaneSegmenter.h>

#include "CellRegions.h"
#include "InverseDepth.h"
#include "PixelLabels.h"

namespace omnimapper::perception::planes {

/// The planes of a depth image and which pixels lie on each: label - 1 is the index of the plane.
struct LabelledPlanes {
  CellRegions regions;
  PixelLabels labels;
};

/// Finds planes by growing and merging cells, then assigns the pixels to them. `inverse` is made from `image`.
LabelledPlanes planesOfCells(const camera::DepthImage& image, const InverseDepth& inverse, const PlaneOptions& options);

/// The thesis's method (3.4.3, 3.4.4): SmoothComparator connects pixels by their normals and offsets. Large components
/// that are flat, not merely smooth, become planes, which then grow over the adjacent pixels that lie on them.
LabelledPlanes planesOfNormals(const camera::DepthImage& image, const InverseDepth& inverse,
                               const PlaneOptions& options);

}  // namespace omnimapper::perception::planes
