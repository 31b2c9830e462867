#include <omnimapper/perception/ColouredPlaneComparator.h>
#include <omnimapper/perception/PlaneComparison.h>

#include "planes/LabelledPlanes.h"

namespace omnimapper::perception {

namespace {

Components connectPlanes(const PlanePixels& pixels, const PlaneComparisonOptions&) {
  return connectComponents(pixels.width, pixels.height, SameLabel{pixels.planes});
}

Components connectColours(const PlanePixels& pixels, const PlaneComparisonOptions& options) {
  return connectPieces(pixels, ColouredPlaneComparator{pixels, options.max_colour_distance});
}

}  // namespace

const PlaneComparison kSamePlane{planes::planesOfCells, connectPlanes};
const PlaneComparison kSamePlaneAndColour{planes::planesOfCells, connectColours, true};
const PlaneComparison kSimilarNormals{planes::planesOfNormals, connectPlanes};

PlaneComparisonOptions::PlaneComparisonOptions() : comparison(&kSamePlane) {}

const base::OptionTable<PlaneComparisonOptions>& PlaneComparisonOptions::table() {
  using Options = PlaneComparisonOptions;
  static const auto table =
      base::OptionTable<Options>()
          .choice<const PlaneComparison*>(
              "comparator", &Options::comparison,
              {{"plane", &kSamePlane}, {"plane_colour", &kSamePlaneAndColour}, {"normals", &kSimilarNormals}},
              "Criterion for neighbouring pixels of one plane. plane: both lie on it. plane_colour: both lie on it and "
              "have one colour, which needs a picture with each depth image. normals: the surface has similar normals "
              "at both, and their tangent planes have similar distances from the camera, as in the thesis.")
          .number("max_colour_distance", &Options::max_colour_distance, {0, 442},
                  "With comparator = plane_colour, two pixels that are at most 2 pixels apart have one colour if their "
                  "RGB values (0 to 255) differ by at most this (Euclidean distance).");
  return table;
}

}  // namespace omnimapper::perception
