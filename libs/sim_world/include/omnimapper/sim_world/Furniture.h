#pragma once

#include <omnimapper/sim_world/Footprint.h>
#include <omnimapper/sim_world/Materials.h>
#include <omnimapper/sim_world/Random.h>
#include <omnimapper/sim_world/WorldPlan.h>

#include <string>
#include <vector>

namespace omnimapper::sim {

class FurniturePiece;

/// A kind of furniture, or of what stands in streets: its usual size, and how it is built.
struct FurnitureShape {
  const char* name;
  double length, width, height;  ///< [m]
  double z;                      ///< usual height of its lowest point above the floor: of what hangs on walls [m]
  SurfaceKind kind;
  const char* material;
  void (*build)(FurniturePiece& piece);
  /// What people call its tops (boards, seats), and what all of its other sides.
  surfaces::SurfaceClass top = surfaces::SurfaceClass::object, sides = surfaces::SurfaceClass::object;
  bool follows_slope = false;  ///< lies on a sloped floor as on a level one: kerbs; all else stands upright
};
const std::vector<FurnitureShape>& furnitureShapes();
const std::vector<FurnitureShape>& outdoorShapes();
/// Null if there is none of that name.
const FurnitureShape* findFurnitureShape(const std::string& name);

/// Sizes that are 0 and an empty material replaced by what is usual.
FurniturePlan withUsualSize(FurniturePlan plan, const FurnitureShape& shape);

/// A body in the frame of FurniturePlan. `plan` has its sizes. Clutter in it is drawn from `random`.
Body makeFurniture(const FurniturePlan& plan, const FurnitureShape& shape, const Track& track, Random random);

/// What the builders of shapes work with: the piece's sizes, and parts of it.
class FurniturePiece {
 public:
  FurniturePiece(MeshBuilder& builder, const FurniturePlan& plan, const FurnitureShape& shape, Random random);

  const double length, width, height;  ///< [m]
  const int boards;
  MeshBuilder& mesh;
  Random random;

  const NamedMaterial& material() const { return main_; }
  /// A surface of a named material, of the piece's own one without a name.
  int part(const std::string& name, const std::string& material = "");
  void box(int surface, const Eigen::Vector3d& low, const Eigen::Vector3d& high);
  /// A box whose top is a plane of its own; the rest belongs to `rest`.
  void slab(const std::string& name, int rest, const Eigen::Vector3d& low, const Eigen::Vector3d& high,
            const std::string& material = "");
  /// A box all of whose faces are planes.
  void cabinet(const Eigen::Vector3d& low, const Eigen::Vector3d& high);
  /// Four legs of a square section inside the outline.
  void legs(int surface, double thickness, double top_z);

 private:
  NamedMaterial materialOf(const std::string& name) const;

  SurfaceKind kind_;
  NamedMaterial main_;
};

}  // namespace omnimapper::sim
