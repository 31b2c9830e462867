#pragma once

#include <omnimapper/perception/DepthImage.h>
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

/// Of cells that are grown and merged, then decided pixel by pixel. `inverse` is that of `image`.
LabelledPlanes planesOfCells(const DepthImage& image, const InverseDepth& inverse, const PlaneOptions& options);

/// The thesis's own way (3.4.3, 3.4.4): pixels are connected by their normals and offsets with SmoothComparator; large
/// components that are flat, not merely smooth, are planes, which grow over the pixels around them that lie on them.
LabelledPlanes planesOfNormals(const DepthImage& image, const InverseDepth& inverse, const PlaneOptions& options);

}  // namespace omnimapper::perception::planes
