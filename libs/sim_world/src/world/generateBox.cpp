#include "PlaceGenerators.h"

namespace omnimapper::sim {

void makeBox(Arrangement& place, const WorldOptions&) {
  const Eigen::Vector2d size(6, 7);
  place.room("box", "room", {0, 0}, size).floor = "linoleum";
  place.raise();
  int count = 0;
  const auto landmark = [&](const Eigen::Vector2d& at) {
    ++count;
    place.plan.landmarks.push_back({"point_" + std::to_string(count), count, at.x(), at.y(), 0.5});
  };
  for (double x = 0.5; x < size.x(); x += 1) {
    landmark({x, 0});
    landmark({x, size.y()});
  }
  for (double y = 0.5; y < size.y(); y += 1) {
    landmark({0, y});
    landmark({size.x(), y});
  }
  for (int i = 0; i < 8; ++i) landmark({place.random.uniform(0.8, 5.2), place.random.uniform(0.8, 6.2)});
}

}  // namespace omnimapper::sim
