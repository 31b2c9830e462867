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
  const PlaneComparison* comparison;  ///< never null; kSamePlane to begin with
  double max_colour_distance = 30;    ///< Euclidean in RGB, in the 256 steps of a channel

  PlaneComparisonOptions();
  static const base::OptionTable<PlaneComparisonOptions>& table();
};

/// A way to tell which neighbouring pixels are of one plane: what `comparator = ...` of an INI means. What is called
/// is called once for an image; the comparators in it are inlined.
struct PlaneComparison {
  /// The planes of an image and which pixels lie on each: planes/LabelledPlanes.h.
  planes::LabelledPlanes (*find)(const DepthImage& image, const planes::InverseDepth& inverse,
                                 const PlaneOptions& options);
  /// Which of a plane's pixels belong together; those of no component are left out.
  Components (*connect)(const PlanePixels& pixels, const PlaneComparisonOptions& options);
  bool needs_colours = false;
};

extern const PlaneComparison kSamePlane;           ///< what is connected and lies on one plane
extern const PlaneComparison kSamePlaneAndColour;  ///< and has one colour: ColouredPlaneComparator
extern const PlaneComparison kSimilarNormals;      ///< flat surfaces by the normals of pixels: SmoothComparator

namespace detail {

/// Whatever lies on a plane may take part where it is similar.
template <class Comparator>
struct OnPlane {
  const Comparator& comparator;
  const std::uint16_t* planes;
  bool valid(int pixel) const { return planes[pixel] != 0; }
  bool similar(int a, int b) const { return comparator.similar(a, b); }
};

}  // namespace detail

/// The pieces into which planes fall by a comparator. Its components are where they begin: pixels of a plane that are
/// in none, or in a speck of one, then join the piece beside them that they are similar to, or else any, if it is at
/// most four pixels away (thesis 3.4.4): noise and thin print leave no holes.
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
