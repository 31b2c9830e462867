#pragma once

#include <omnimapper/perception/ConnectedComponents.h>
#include <omnimapper/perception/PlanePixels.h>

namespace omnimapper::perception {

/// Comparator for connectComponents(): joins neighbours on one plane and of one colour (thesis 3.4.5), such as the
/// pixels of a sheet of paper on a table. In a picture, the edge between two colours is some pixels wide, so that
/// neighbours on it differ by little. Therefore a pixel belongs to no component if the colours `reach` pixels to its
/// two sides differ. Light that changes slowly separates nothing.
struct ColouredPlaneComparator {
  PlanePixels pixels;
  double max_distance = 30;  ///< Euclidean in RGB, in the 256 steps of a channel
  int reach = 2;             ///< [px] distance at which colours are compared, to either side

  bool valid(int pixel) const {
    const int column = pixel % pixels.width, row = pixel / pixels.width;
    return pixels.planes[pixel] != 0 && isPlain(pixel, 1, column, pixels.width - 1 - column) &&
           isPlain(pixel, pixels.width, row, pixels.height - 1 - row);
  }

  bool similar(int a, int b) const { return pixels.planes[a] == pixels.planes[b] && isAlike(a, b); }

 private:
  bool isAlike(int a, int b) const {
    const obs::Rgb &p = pixels.colours[a], &q = pixels.colours[b];
    const int red = p.red - q.red, green = p.green - q.green, blue = p.blue - q.blue;
    return red * red + green * green + blue * blue <= max_distance * max_distance;
  }

  // True if the colour is the same on both sides of a pixel, along the row (step 1) or the column (step width).
  // `before` and `behind`: numbers of pixels between this pixel and the image's border on the two sides.
  bool isPlain(int pixel, int step, int before, int behind) const {
    const int one = onPlane(pixel, -step, before), other = onPlane(pixel, step, behind);
    return isAlike(one, other) && isAlike(pixel, one);
  }

  // The farthest pixel within `reach` that is on the same plane. `step` leads from one pixel to the next; there are
  // `room` pixels up to the image's border.
  int onPlane(int pixel, int step, int room) const {
    int other = pixel + step * (reach < room ? reach : room);
    while (pixels.planes[other] != pixels.planes[pixel]) other -= step;
    return other;
  }
};

extern template Components connectComponents(int, int, const ColouredPlaneComparator&);

}  // namespace omnimapper::perception
