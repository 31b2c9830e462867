#include <omnimapper/perception/ConnectedComponents.h>

#include <algorithm>

namespace omnimapper::perception {

std::vector<std::int32_t> Components::labels(int fewest) const {
  std::vector<std::int32_t> image(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  for (const PixelRun& run : runs) {
    if (pixels[static_cast<std::size_t>(run.component)] < fewest) continue;
    const auto row = image.begin() + static_cast<std::ptrdiff_t>(run.row) * width;
    std::fill(row + run.begin, row + run.end, run.component + 1);
  }
  return image;
}

namespace detail {

void numberComponents(UnionFind& sets, Components& components) {
  // The run with the number i was the i-th; the first run of a set has its least number.
  std::vector<int> number(components.runs.size());
  for (std::size_t i = 0; i < components.runs.size(); ++i) {
    PixelRun& run = components.runs[i];
    const auto root = static_cast<std::size_t>(sets.find(static_cast<int>(i)));
    if (root == i) {
      number[i] = static_cast<int>(components.pixels.size());
      components.pixels.push_back(0);
    }
    run.component = number[root];
    components.pixels[static_cast<std::size_t>(run.component)] += run.end - run.begin;
  }
}

}  // namespace detail

}  // namespace omnimapper::perception
