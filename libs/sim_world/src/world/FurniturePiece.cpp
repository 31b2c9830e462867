#include <omnimapper/sim_world/Furniture.h>
#include <omnimapper/sim_world/Materials.h>

namespace omnimapper::sim {

using Eigen::Vector3d;

FurniturePiece::FurniturePiece(MeshBuilder& builder, const FurniturePlan& plan, const FurnitureShape& shape,
                               Random stream)
    : length(plan.length),
      width(plan.width),
      height(plan.height),
      boards(plan.boards),
      mesh(builder),
      random(stream),
      kind_(shape.kind),
      main_(materialNamed(plan.material)) {}

NamedMaterial FurniturePiece::materialOf(const std::string& name) const {
  return name.empty() ? main_ : materialNamed(name);
}

int FurniturePiece::part(const std::string& name, const std::string& material) {
  const NamedMaterial look = materialOf(material);
  mesh.layout(look.layout);
  return mesh.addSurface(name, kind_, look.material);
}

void FurniturePiece::box(int surface, const Vector3d& low, const Vector3d& high) {
  mesh.addBox(surface, low, high);
}

void FurniturePiece::slab(const std::string& name, int rest, const Vector3d& low, const Vector3d& high,
                          const std::string& material) {
  mesh.addBoxWithoutTop(rest, low, high);
  const NamedMaterial look = materialOf(material);
  mesh.layout(look.layout);
  mesh.addPlane(name, kind_, look.material,
                {{low.x(), low.y(), high.z()}, {high.x(), low.y(), high.z()}, high, {low.x(), high.y(), high.z()}});
}

void FurniturePiece::cabinet(const Vector3d& low, const Vector3d& high) {
  mesh.layout(main_.layout).addBoxOfPlanes("", kind_, main_.material, low, high);
}

void FurniturePiece::legs(int surface, double thickness, double top_z) {
  const double x = length / 2 - 0.03, y = width / 2 - 0.03;
  for (const double side : {-1.0, 1.0}) {
    for (const double end : {-1.0, 1.0}) {
      const double outer_x = end * x, outer_y = side * y, inner_x = end * (x - thickness),
                   inner_y = side * (y - thickness);
      mesh.addBox(surface, {std::min(outer_x, inner_x), std::min(outer_y, inner_y), 0},
                  {std::max(outer_x, inner_x), std::max(outer_y, inner_y), top_z});
    }
  }
}

const FurnitureShape* findFurnitureShape(const std::string& name) {
  for (const auto* shapes : {&furnitureShapes(), &outdoorShapes()}) {
    for (const FurnitureShape& shape : *shapes) {
      if (shape.name == name) return &shape;
    }
  }
  return nullptr;
}

FurniturePlan withUsualSize(FurniturePlan plan, const FurnitureShape& shape) {
  if (plan.length == 0) plan.length = shape.length;
  if (plan.width == 0) plan.width = shape.width;
  if (plan.height == 0) plan.height = shape.height;
  if (plan.z == 0) plan.z = shape.z;
  if (plan.material.empty()) plan.material = shape.material;
  return plan;
}

Body makeFurniture(const FurniturePlan& plan, const FurnitureShape& shape, const Track& track, Random random) {
  MeshBuilder builder(plan.name, track);
  FurniturePiece piece(builder, plan, shape, random);
  shape.build(piece);
  Body body = builder.build();
  for (Surface& surface : body.surfaces) {
    const bool is_top = surface.face && surface.face->plane_in_body.normal.z() > 1 - 1e-9;
    surface.is = is_top ? shape.top : shape.sides;
    if (surface.name.find("/books_") != std::string::npos) surface.is = surfaces::SurfaceClass::object;
  }
  return body;
}

}  // namespace omnimapper::sim
