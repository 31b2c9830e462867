#pragma once

#include <omnimapper/perception/ConnectedComponents.h>
#include <omnimapper/perception/PlanePixels.h>

namespace omnimapper::perception {

/// Comparator: neighbours on one plane and of one colour (thesis 3.4.5), such as those of a sheet of paper on a table.
/// The edge between two colours is some pixels wide in a picture, so that neighbours there differ by little: pixels
/// across which the colour changes within `reach` belong to no component. Light that changes slowly separates nothing.
struct ColouredPlaneComparator {
  PlanePixels pixels;
  double max_distance = 30;  ///< Euclidean in RGB, in the 256 steps of a channel
  int reach = 2;             ///< [px] on either side

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

  // Whether the colour does not change across a pixel, along the row (step 1) or the column (step width). There are
  // `before` and `behind` pixels on its two sides.
  bool isPlain(int pixel, int step, int before, int behind) const {
    const int one = onPlane(pixel, -step, before), other = onPlane(pixel, step, behind);
    return isAlike(one, other) && isAlike(pixel, one);
  }

  // The farthest pixel within reach on the same plane; `step` leads from one pixel to the next.
  int onPlane(int pixel, int step, int room) const {
    int other = pixel + step * (reach < room ? reach : room);
    while (pixels.planes[other] != pixels.planes[pixel]) other -= step;
    return other;
  }
};

extern template Components connectComponents(int, int, const ColouredPlaneComparator&);

}  // namespace omnimapper::perception
