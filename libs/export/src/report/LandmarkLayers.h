#pragma once

#include <string>
#include <vector>

#include "grid/GridPicture.h"
#include "plan/LandmarkShapes.h"

namespace omnimapper::exports {

/// The landmarks of one label as a layer of the report's map.
struct LandmarkLayer {
  std::string name;  ///< the class of its group
  std::string label, colour;
  std::size_t count = 0;
  bool shown = true;  ///< floors and ceilings are not, until somebody asks for them
  std::string svg;    ///< a group, in pixels of the picture
};

/// Floors and ceilings first, for they are under all else; then in the order of labels.
std::vector<LandmarkLayer> landmarkLayers(const GridPicture& grid, const std::vector<ShapedLandmark>& landmarks);

/// A walk as the data of an SVG path.
std::string svgPath(const std::vector<draw::PixelPoint>& walk);

}  // namespace omnimapper::exports
