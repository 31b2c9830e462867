#pragma once

#include <omnimapper/sim_world/Body.h>

#include <string>
#include <vector>

namespace omnimapper::sim {

/// How a texture lies on a face. On a flat face, seen from the side that its normal points to, u runs to the right and
/// v up; up is towards z, or towards y if the face is level. On a round face u runs around and v along its profile.
struct TextureLayout {
  Eigen::Vector2d tile{1, 1};  ///< width and height of one picture [m]; 0: one picture fills the face
  static TextureLayout fitted() { return {{0, 0}}; }
};

/// A corner of a profile that is turned about z.
struct ProfilePoint {
  double radius = 0, z = 0;  ///< [m]
};

/// Builds a body, part by part. Coordinates are in the frame that at() sets; at first it is the frame of the body.
/// Faces are counter-clockwise seen from outside; std::invalid_argument is thrown for parts without an extent.
class MeshBuilder {
 public:
  explicit MeshBuilder(std::string body_name, Track track = Track(geometry::Se3{}));

  /// Sets the frame of the coordinates that follow.
  MeshBuilder& at(const geometry::Se3& body_from_part);
  MeshBuilder& layout(const TextureLayout& layout);

  /// Adds a surface that is called "<body>/<part>" or, without a part, "<body>". Returns its number.
  int addSurface(const std::string& part, SurfaceKind kind, const Material& material);

  /// Adds a flat face to a surface; holes are strictly inside, clockwise or counter-clockwise.
  void addFace(int surface, const std::vector<Eigen::Vector3d>& outline,
               const std::vector<std::vector<Eigen::Vector3d>>& holes = {});
  /// Adds a surface of one flat face and records that face as its truth (Surface::face). Returns its number.
  int addPlane(const std::string& part, SurfaceKind kind, const Material& material,
               const std::vector<Eigen::Vector3d>& outline,
               const std::vector<std::vector<Eigen::Vector3d>>& holes = {});

  /// Adds all six faces of a box to one surface.
  void addBox(int surface, const Eigen::Vector3d& low, const Eigen::Vector3d& high);
  /// Adds the faces of a box except its top to one surface.
  void addBoxWithoutTop(int surface, const Eigen::Vector3d& low, const Eigen::Vector3d& high);
  /// Adds a box whose six faces are planes: "<part>top", "<part>bottom", "<part>front" (-y), "<part>back" (+y),
  /// "<part>left" (-x) and "<part>right" (+x).
  void addBoxOfPlanes(const std::string& part, SurfaceKind kind, const Material& material, const Eigen::Vector3d& low,
                      const Eigen::Vector3d& high);
  /// Adds an upright prism over a simple polygon that goes counter-clockwise.
  void addPrism(int surface, const std::vector<Eigen::Vector2d>& outline, double low_z, double high_z);
  /// Adds the surface of a profile that is turned about z. The points of the profile go upwards along the outside of
  /// the solid. Where the profile does not begin or end at radius 0, the solid gets a flat end.
  void addRevolution(int surface, const std::vector<ProfilePoint>& profile, int sides = 24);
  void addCylinder(int surface, double radius, double low_z, double high_z, int sides = 24);
  void addCone(int surface, double radius, double low_z, double tip_z, int sides = 24);
  /// Adds a sphere about the origin of the frame that at() sets.
  void addSphere(int surface, double radius, int sides = 24);

  int surfaceCount() const { return static_cast<int>(body_.surfaces.size()); }
  /// The body; the builder is empty afterwards.
  Body build();

 private:
  int addVertex(const Eigen::Vector3d& in_part);

  Body body_;
  geometry::Se3 body_from_part_;
  TextureLayout layout_;
};

/// Area of a planar face: its outline less its holes [m^2].
double areaOf(const PlanarFace& face);

}  // namespace omnimapper::sim
