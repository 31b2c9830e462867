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
  // The root of a set is its smallest number, that of the component's first run, so roots are met from top to bottom.
  std::vector<int> number(static_cast<std::size_t>(sets.size()));
  int count = 0;
  for (int i = 0; i < sets.size(); ++i) {
    const int root = sets.find(i);
    number[static_cast<std::size_t>(i)] = root == i ? count++ : number[static_cast<std::size_t>(root)];
  }
  components.pixels.assign(static_cast<std::size_t>(count), 0);
  for (PixelRun& run : components.runs) {
    run.component = number[static_cast<std::size_t>(run.component)];
    components.pixels[static_cast<std::size_t>(run.component)] += run.end - run.begin;
  }
}

}  // namespace detail

}  // namespace omnimapper::perception
