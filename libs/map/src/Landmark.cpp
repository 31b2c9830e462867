#include <omnimapper/map/Landmark.h>

namespace omnimapper::map {

std::vector<geometry::Polygon3> holesIn(const LandmarkShape& shape, std::size_t surface) {
  std::vector<geometry::Polygon3> holes;
  for (const auto& hole : shape.holes) {
    if (hole.vertices.size() < 3) continue;
    const Eigen::Vector3d middle = (hole.vertices[0] + hole.vertices[1]) / 2;  // a corner may lie on the outline
    const auto goesAround = [&](std::size_t i) { return geometry::contains(shape.surfaces[i], middle); };
    if (!goesAround(surface)) continue;
    bool is_smallest = true;
    for (std::size_t i = 0; i < shape.surfaces.size(); ++i)
      is_smallest = is_smallest && (i == surface || !goesAround(i) ||
                                    geometry::area(shape.surfaces[i]) > geometry::area(shape.surfaces[surface]));
    if (is_smallest) holes.push_back(hole);
  }
  return holes;
}

std::array<Eigen::Vector3d, 8> Box::corners() const {
  std::array<Eigen::Vector3d, 8> all;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Eigen::Vector3d side((i & 1) != 0 ? 0.5 : -0.5, (i & 2) != 0 ? 0.5 : -0.5, (i & 4) != 0 ? 0.5 : -0.5);
    all[i] = middle + map_from_box * side.cwiseProduct(size);
  }
  return all;
}

}  // namespace omnimapper::map
