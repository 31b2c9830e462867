#pragma once

#include <omnimapper/sim_world/Footprint.h>
#include <omnimapper/sim_world/Materials.h>
#include <omnimapper/sim_world/Random.h>
#include <omnimapper/sim_world/WorldPlan.h>

#include <string>
#include <vector>

namespace omnimapper::sim {

class FurniturePiece;

/// A kind of furniture, indoors or in streets: its usual size, and how it is built.
struct FurnitureShape {
  const char* name;
  double length, width, height;  ///< [m]
  double z;  ///< usual height of the lowest point above the floor, for shapes that hang on walls [m]
  SurfaceKind kind;
  const char* material;
  void (*build)(FurniturePiece& piece);
  /// Classes of its tops (boards, seats) and of all other sides.
  surfaces::SurfaceClass top = surfaces::SurfaceClass::object, sides = surfaces::SurfaceClass::object;
  bool follows_slope = false;  ///< tilts with a sloped floor, as kerbs do; other furniture stands upright
};
const std::vector<FurnitureShape>& furnitureShapes();
const std::vector<FurnitureShape>& outdoorShapes();
/// Null if there is none of that name.
const FurnitureShape* findFurnitureShape(const std::string& name);

/// The plan with the usual sizes instead of those that are 0, and with the usual material instead of an empty one.
FurniturePlan withUsualSize(FurniturePlan plan, const FurnitureShape& shape);

/// A body in the frame of FurniturePlan. No size in `plan` may be 0. Clutter in the furniture is drawn from `random`.
Body makeFurniture(const FurniturePlan& plan, const FurnitureShape& shape, const Track& track, Random random);

/// A piece of furniture that is being built. The functions that build shapes take its sizes from here, and add parts by
/// its member functions.
class FurniturePiece {
 public:
  FurniturePiece(MeshBuilder& builder, const FurniturePlan& plan, const FurnitureShape& shape, Random random);

  const double length, width, height;  ///< [m]
  const int boards;
  MeshBuilder& mesh;
  Random random;

  const NamedMaterial& material() const { return main_; }
  /// Adds a surface of the named material, or of the piece's material if `material` is empty. Returns the number of the
  /// surface.
  int part(const std::string& name, const std::string& material = "");
  void box(int surface, const Eigen::Vector3d& low, const Eigen::Vector3d& high);
  /// A box whose top is a new planar surface `name`; its other faces belong to surface `rest`.
  void slab(const std::string& name, int rest, const Eigen::Vector3d& low, const Eigen::Vector3d& high,
            const std::string& material = "");
  /// A box whose faces are all new planar surfaces.
  void cabinet(const Eigen::Vector3d& low, const Eigen::Vector3d& high);
  /// Four legs with a square section, inside the outline.
  void legs(int surface, double thickness, double top_z);

 private:
  NamedMaterial materialOf(const std::string& name) const;

  SurfaceKind kind_;
  NamedMaterial main_;
};

}  // namespace omnimapper::sim
