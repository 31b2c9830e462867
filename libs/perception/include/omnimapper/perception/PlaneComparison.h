#pragma once

#include <omnimapper/base/OptionTable.h>
#include <omnimapper/camera/DepthImage.h>
#include <omnimapper/perception/ConnectedComponents.h>
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
  bool operator==(const PlaneComparisonOptions& other) const {
    return comparison == other.comparison && max_colour_distance == other.max_colour_distance;
  }
  static const base::OptionTable<PlaneComparisonOptions>& table();
};

/// A criterion by which neighbouring pixels belong to one plane; an INI chooses it by `comparator = ...`. Each function
/// is called once for an image; the comparator that decides about single pixels is inlined in it.
struct PlaneComparison {
  /// Finds the planes of an image and which pixels lie on each; see planes/LabelledPlanes.h.
  planes::LabelledPlanes (*find)(const camera::DepthImage& image, const planes::InverseDepth& inverse,
                                 const PlaneOptions& options);
  /// Finds which pixels of a plane belong together. Pixels in no component are removed from their plane.
  Components (*connect)(const PlanePixels& pixels, const PlaneComparisonOptions& options);
  bool needs_colours = false;
};

extern const PlaneComparison kSamePlane;           ///< connected pixels on one plane
extern const PlaneComparison kSamePlaneAndColour;  ///< the same, and of one colour: ColouredPlaneComparator
extern const PlaneComparison kSimilarNormals;      ///< flat surfaces, by the normals of pixels: SmoothComparator

namespace detail {

/// A comparator for which all pixels on planes are valid; `comparator` decides which ones are similar.
template <class Comparator>
struct OnPlane {
  const Comparator& comparator;
  const std::uint16_t* planes;
  bool valid(int pixel) const { return planes[pixel] != 0; }
  bool similar(int a, int b) const { return comparator.similar(a, b); }
};

}  // namespace detail

/// Splits planes into pieces by a comparator. Each component of at least 16 pixels is the core of a piece. The other
/// pixels of a plane then join a piece that is at most four pixels away: first a piece to which they are similar, and
/// if there is none, any piece of their plane (thesis 3.4.4). Noise and thin print therefore leave no holes.
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
