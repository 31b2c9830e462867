#pragma once

#include <omnimapper/derived/GridPicture.h>
#include <omnimapper/derived/LandmarkShapes.h>

#include <string>
#include <vector>

namespace omnimapper::plugins {

/// The landmarks of one label as a layer of the report's map.
struct LandmarkLayer {
  std::string name;  ///< CSS class of its group
  std::string label, colour;
  std::size_t count = 0;
  bool shown = true;  ///< false for floors and ceilings, which are hidden until they are switched on
  std::string svg;    ///< an SVG group in pixels of the picture
};

/// One layer for each label: floors and ceilings first, because they lie under all others, then in the order of labels.
std::vector<LandmarkLayer> landmarkLayers(const derived::GridPicture& grid,
                                          const std::vector<derived::ShapedLandmark>& landmarks);

/// The data of an SVG path through the given points.
std::string svgPath(const std::vector<draw::PixelPoint>& walk);

}  // namespace omnimapper::plugins
