#include "LabelledPlanes.h"
#include "SmallRegions.h"

namespace omnimapper::perception::planes {

LabelledPlanes planesOfCells(const camera::DepthImage& image, const InverseDepth& inverse,
                             const PlaneOptions& options) {
  const camera::DepthNoise noise = options.noise();
  const CellGrid grid = fitCells(inverse, image.camera(), noise);
  const CellRegions merged = mergeRegions(grid, noise, growRegions(grid, noise));
  LabelledPlanes planes;
  planes.regions = dropExplained(inverse, image.camera(), noise, grid, merged);
  planes.labels = labelPixels(inverse, image.camera(), noise, grid, planes.regions);
  return planes;
}

}  // namespace omnimapper::perception::planes
