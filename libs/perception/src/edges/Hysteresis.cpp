#include "Hysteresis.h"

namespace omnimapper::perception::edges {

void Candidates::keepConnected(int fewest) {
  const int around[8] = {-stride_ - 1, -stride_, -stride_ + 1, -1, 1, stride_ - 1, stride_, stride_ + 1};
  std::vector<int> component;
  for (const int seed : strong_) {
    if (values_[static_cast<std::size_t>(seed)] == kKept || values_[static_cast<std::size_t>(seed)] == kNothing)
      continue;
    component.assign(1, seed);
    values_[static_cast<std::size_t>(seed)] = kKept;
    for (std::size_t next = 0; next < component.size(); ++next) {
      for (const int step : around) {
        const int neighbour = component[next] + step;
        std::uint8_t& value = values_[static_cast<std::size_t>(neighbour)];
        if (value == kNothing || value == kKept) continue;
        value = kKept;
        component.push_back(neighbour);
      }
    }
    if (static_cast<int>(component.size()) >= fewest) continue;
    for (const int pixel : component) values_[static_cast<std::size_t>(pixel)] = kNothing;
  }
}

}  // namespace omnimapper::perception::edges
