#include "SignPlate.h"

#include <omnimapper/sim_world/MeshBuilder.h>

#include <vector>

namespace omnimapper::sim {

Body makePlate(const SignPlate& plate) {
  const double x = plate.width / 2, y = plate.height / 2, back = -plate.thickness;
  MeshBuilder builder(plate.name, Track(plate.map_from_plate));
  builder.layout(TextureLayout::fitted());
  Material front;
  front.colour = Eigen::Vector3f::Ones();
  front.texture = plate.picture;
  builder.addPlane("", plate.kind, front, {{-x, -y, 0}, {x, -y, 0}, {x, y, 0}, {-x, y, 0}});
  Material rest;
  rest.colour = plate.edge_colour;
  const int edge = builder.addSurface("edge", plate.kind, rest);
  builder.addFace(edge, {{-x, y, back}, {x, y, back}, {x, -y, back}, {-x, -y, back}});
  const std::vector<Eigen::Vector2d> corners{{-x, -y}, {x, -y}, {x, y}, {-x, y}};
  for (int i = 0; i < 4; ++i) {
    const Eigen::Vector2d &a = corners[i], &b = corners[(i + 1) % 4];
    builder.addFace(edge, {{a.x(), a.y(), back}, {b.x(), b.y(), back}, {b.x(), b.y(), 0}, {a.x(), a.y(), 0}});
  }
  return builder.build();
}

}  // namespace omnimapper::sim
