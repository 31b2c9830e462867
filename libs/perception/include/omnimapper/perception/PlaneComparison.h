#pragma once

#include <omnimapper/base/OptionTable.h>
#include <omnimapper/perception/ConnectedComponents.h>
#include <omnimapper/perception/DepthImage.h>
#include <omnimapper/perception/GrowLabels.h>
#include <omnimapper/perception/PlanePixels.h>
#include <omnimapper/perception/SameLabel.h>

namespace omnimapper::perception {

struct PlaneComparison;
struct PlaneOptions;
namespace planes {
struct InverseDepth;
struct LabelledPlanes;
}  // namespace planes

struct PlaneComparisonOptions {
  const PlaneComparison* comparison;  ///< never null; kSamePlane by default
  double max_colour_distance = 30;    ///< Euclidean in RGB, in the 256 steps of a channel

  PlaneComparisonOptions();
  static const base::OptionTable<PlaneComparisonOptions>& table();
};

/// A criterion for which neighbouring pixels are of one plane; an INI chooses it by `comparator = ...`. Its functions
/// are called once for an image; the comparators in them are inlined.
struct PlaneComparison {
  /// Finds the planes of an image and which pixels lie on each; see planes/LabelledPlanes.h.
  planes::LabelledPlanes (*find)(const DepthImage& image, const planes::InverseDepth& inverse,
                                 const PlaneOptions& options);
  /// Finds which of a plane's pixels belong together; pixels of no component are left out.
  Components (*connect)(const PlanePixels& pixels, const PlaneComparisonOptions& options);
  bool needs_colours = false;
};

extern const PlaneComparison kSamePlane;           ///< connected pixels on one plane
extern const PlaneComparison kSamePlaneAndColour;  ///< the same, and of one colour: ColouredPlaneComparator
extern const PlaneComparison kSimilarNormals;      ///< flat surfaces, by the normals of pixels: SmoothComparator

namespace detail {

/// A comparator for which all pixels on planes are valid; which ones are similar, `comparator` decides.
template <class Comparator>
struct OnPlane {
  const Comparator& comparator;
  const std::uint16_t* planes;
  bool valid(int pixel) const { return planes[pixel] != 0; }
  bool similar(int a, int b) const { return comparator.similar(a, b); }
};

}  // namespace detail

/// Splits planes into pieces by a comparator. Each of its components is the start of a piece, except for specks. The
/// other pixels of a plane then join a piece beside them that they are similar to, or else any piece, if it is at most
/// four pixels away (thesis 3.4.4), so that noise and thin print leave no holes.
template <class Comparator>
Components connectPieces(const PlanePixels& pixels, const Comparator& comparator) {
  constexpr int kFewest = 16, kRings = 4;
  const int width = pixels.width, height = pixels.height;
  auto pieces = connectComponents(width, height, comparator).labels(kFewest);
  growLabels(width, height, detail::OnPlane<Comparator>{comparator, pixels.planes}, kRings, pieces);
  growLabels(width, height, SameLabel{pixels.planes}, kRings, pieces);
  return connectComponents(width, height, SameLabel<std::int32_t>{pieces.data()});
}

}  // namespace omnimapper::perception
