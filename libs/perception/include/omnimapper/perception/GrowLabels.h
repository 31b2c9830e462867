#pragma once

#include <cstdint>
#include <vector>

namespace omnimapper::perception {

/// Gives pixels without a label (0) the label of a neighbour: ring by ring around the pixels that have a label, at most
/// `rings` rings (thesis 3.4.4, in one pass over the pixels that change). The comparator is one that
/// connectComponents() could use. A pixel takes the label of its neighbour if the pixel is valid and similar(neighbour,
/// pixel) holds, whichever of the two comes first in the image.
template <class Comparator>
void growLabels(int width, int height, const Comparator& comparator, int rings, std::vector<std::int32_t>& labels) {
  const auto at = [&](int pixel) -> std::int32_t& { return labels[static_cast<std::size_t>(pixel)]; };
  const auto visitAround = [&](int pixel, const auto& visit) {
    const int x = pixel % width, y = pixel / width;
    if (x > 0) visit(pixel - 1);
    if (x + 1 < width) visit(pixel + 1);
    if (y > 0) visit(pixel - width);
    if (y + 1 < height) visit(pixel + width);
  };
  std::vector<int> front;
  for (int y = 0, pixel = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x, ++pixel) {
      if (at(pixel) == 0) continue;
      if ((x > 0 && at(pixel - 1) == 0) || (x + 1 < width && at(pixel + 1) == 0) || (y > 0 && at(pixel - width) == 0) ||
          (y + 1 < height && at(pixel + width) == 0))
        front.push_back(pixel);
    }
  }
  for (std::size_t k = 0, end_of_ring = front.size(); k < front.size() && rings > 0; ++k) {
    const int pixel = front[k];
    visitAround(pixel, [&](int neighbour) {
      if (at(neighbour) != 0 || !comparator.valid(neighbour) || !comparator.similar(pixel, neighbour)) return;
      at(neighbour) = at(pixel);
      front.push_back(neighbour);
    });
    if (k + 1 != end_of_ring) continue;
    end_of_ring = front.size();
    --rings;
  }
}

}  // namespace omnimapper::perception
