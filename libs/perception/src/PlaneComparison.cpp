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
              "Neighbouring pixels are of one plane if they lie on it; plane_colour: and have one colour, for which "
              "each scan needs a picture; normals: if their normals are alike, as the thesis has it.")
          .number("max_colour_distance", &Options::max_colour_distance, {0, 442},
                  "plane_colour: colours that differ by more from one pixel to the next few are two; Euclidean in RGB, "
                  "in the 256 steps of a channel.");
  return table;
}

}  // namespace omnimapper::perception
