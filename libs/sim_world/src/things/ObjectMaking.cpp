#include <omnimapper/base/Config.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/sim_world/ObjectMaking.h>

#include "objectShapes.h"

namespace omnimapper::sim {

namespace {

struct Extent {
  Eigen::Vector3d low, high;
};
Extent extentOf(const Body& body) {
  Extent extent{body.vertices_in_body.front(), body.vertices_in_body.front()};
  for (const Eigen::Vector3d& p : body.vertices_in_body) {
    extent.low = extent.low.cwiseMin(p);
    extent.high = extent.high.cwiseMax(p);
  }
  return extent;
}

const ObjectShape& shapeOf(const ObjectSpec& spec) {
  std::string known;
  for (const ObjectShape& shape : shapesOfObjects()) {
    if (shape.name == spec.shape) return shape;
    known += (known.empty() ? "" : ", ") + shape.name;
  }
  const std::string near = base::nearestName(spec.shape, objectShapes());
  throw base::Error(base::ExitCode::out_of_range, "object '" + spec.name + "': shape '" + spec.shape + "' is unknown" +
                                                      (near.empty() ? "" : "; did you mean '" + near + "'?") +
                                                      " Known shapes: " + known);
}

}  // namespace

const std::vector<std::string>& objectShapes() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> list;
    for (const ObjectShape& shape : shapesOfObjects()) list.push_back(shape.name);
    return list;
  }();
  return names;
}

const std::vector<std::string>& carryingShapes() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> list;
    for (const ObjectShape& shape : shapesOfObjects()) {
      if (shape.top) list.push_back(shape.name);
    }
    return list;
  }();
  return names;
}

Eigen::Vector3d extentsOf(const Body& body) {
  if (body.vertices_in_body.empty()) return Eigen::Vector3d::Zero();
  const Extent extent = extentOf(body);
  return extent.high - extent.low;
}

MadeObject makeObject(const ObjectSpec& spec) {
  const ObjectShape& shape = shapeOf(spec);
  if (spec.size && !(spec.size->minCoeff() > 0)) {
    throw base::Error(base::ExitCode::out_of_range,
                      "object '" + spec.name + "': its size must be positive along x, y and z");
  }
  constexpr std::uint64_t kStream = 0x0b1ec7;
  Random random(spec.seed, {kStream, static_cast<std::uint64_t>(&shape - shapesOfObjects().data())});
  const double scale = random.uniform(0.85, 1.15);
  MeshBuilder builder(spec.name, Track(spec.map_from_object));
  builder.layout(TextureLayout::fitted());
  shape.add(builder, random);
  Body body = builder.build();

  const Eigen::Vector3d usual = extentsOf(body);
  const Eigen::Vector3d factor = spec.size.value_or(scale * usual).cwiseQuotient(usual);
  const double base_z = extentOf(body).low.z();
  for (Eigen::Vector3d& p : body.vertices_in_body) {
    p.z() -= base_z;
    p = p.cwiseProduct(factor);
  }
  std::optional<LevelTop> top = shape.top;
  if (top) {
    top->z = (top->z - base_z) * factor.z();
    for (Eigen::Vector2d& p : top->outline_in_body) p = p.cwiseProduct(factor.head<2>());
  }
  return {std::move(body), {spec.name, spec.shape, spec.moveable}, std::move(top)};
}

}  // namespace omnimapper::sim
