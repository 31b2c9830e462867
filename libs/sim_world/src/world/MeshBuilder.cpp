#include <omnimapper/sim_world/MeshBuilder.h>
#include <omnimapper/sim_world/Triangulate.h>

#include <cmath>
#include <stdexcept>

namespace omnimapper::sim {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Loop = std::vector<Vector3d>;

// Twice the area times the normal (Newell).
Vector3d areaVector(const Loop& loop) {
  Vector3d sum = Vector3d::Zero();
  for (std::size_t i = 0; i < loop.size(); ++i) {
    sum += (loop[i] - loop[0]).cross(loop[(i + 1) % loop.size()] - loop[0]);
  }
  return sum;
}

// Axes of a face seen from its front: to the right, and up.
struct Axes {
  Vector3d right, up;
};
Axes axesOf(const Vector3d& normal) {
  const bool level = std::abs(normal.z()) > 1 - 1e-9;
  const Vector3d up_guess = level ? Vector3d::UnitY() : Vector3d::UnitZ();
  const Vector3d up = (up_guess - up_guess.dot(normal) * normal).normalized();
  return {up.cross(normal), up};
}

Ring flatten(const Loop& loop, const Axes& axes) {
  Ring ring;
  for (const Vector3d& p : loop) ring.emplace_back(axes.right.dot(p), axes.up.dot(p));
  return ring;
}

// The origin of the texture and the size of one picture, for a face with this outline.
struct Tiling {
  Vector2d origin = Vector2d::Zero(), size = Vector2d::Ones();
  Eigen::Vector2f at(const Vector2d& p) const { return (p - origin).cwiseQuotient(size).cast<float>(); }
};
Tiling tilingOf(const Vector2d& tile, const Ring& outline) {
  Vector2d low = outline.front(), high = low;
  for (const Vector2d& p : outline) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  Tiling tiling{low, tile};
  for (int axis = 0; axis < 2; ++axis) {
    if (tile[axis] <= 0) tiling.size[axis] = high[axis] - low[axis];
  }
  return tiling;
}

}  // namespace

MeshBuilder::MeshBuilder(std::string body_name, Track track) {
  body_.name = std::move(body_name);
  body_.track = std::move(track);
}

MeshBuilder& MeshBuilder::at(const geometry::Se3& body_from_part) {
  body_from_part_ = body_from_part;
  return *this;
}

MeshBuilder& MeshBuilder::layout(const TextureLayout& layout) {
  layout_ = layout;
  return *this;
}

int MeshBuilder::addSurface(const std::string& part, SurfaceKind kind, const Material& material) {
  body_.surfaces.push_back({part.empty() ? body_.name : body_.name + "/" + part, kind, material, {}, usualClass(kind)});
  return surfaceCount() - 1;
}

int MeshBuilder::addVertex(const Vector3d& in_part) {
  body_.vertices_in_body.push_back(body_from_part_ * in_part);
  return static_cast<int>(body_.vertices_in_body.size()) - 1;
}

void MeshBuilder::addFace(int surface, const Loop& outline, const std::vector<Loop>& holes) {
  const Vector3d area = areaVector(outline);
  if (outline.size() < 3 || area.norm() < 1e-12) {
    throw std::invalid_argument(body_.name + ": a face without an area");
  }
  const Axes axes = axesOf(area.normalized());
  std::vector<Ring> rings{flatten(outline, axes)};
  for (const Loop& hole : holes) rings.push_back(flatten(hole, axes));
  const Tiling tiling = tilingOf(layout_.tile, rings.front());

  std::vector<int> vertices;
  std::vector<Eigen::Vector2f> texture_at;
  const auto add = [&](const Loop& loop, const Ring& ring) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      vertices.push_back(addVertex(loop[i]));
      texture_at.push_back(tiling.at(ring[i]));
    }
  };
  add(outline, rings.front());
  for (std::size_t i = 0; i < holes.size(); ++i) add(holes[i], rings[i + 1]);
  for (const auto& corners : triangulate(rings)) {
    Triangle triangle;
    triangle.surface = surface;
    for (int i = 0; i < 3; ++i) {
      triangle.corners[i] = vertices[corners[i]];
      triangle.texture_at[i] = texture_at[corners[i]];
    }
    body_.triangles.push_back(triangle);
  }
}

int MeshBuilder::addPlane(const std::string& part, SurfaceKind kind, const Material& material, const Loop& outline,
                          const std::vector<Loop>& holes) {
  const int surface = addSurface(part, kind, material);
  addFace(surface, outline, holes);
  const auto inBody = [&](const Loop& loop) {
    Loop result;
    for (const Vector3d& p : loop) result.push_back(body_from_part_ * p);
    return result;
  };
  PlanarFace face;
  face.outline_in_body = inBody(outline);
  for (const Loop& hole : holes) face.holes_in_body.push_back(inBody(hole));
  face.plane_in_body =
      geometry::Plane3::through(face.outline_in_body.front(), areaVector(face.outline_in_body).normalized());
  body_.surfaces[surface].face = std::move(face);
  return surface;
}

namespace {

struct BoxFace {
  const char* name;
  std::array<int, 4> corners;  // bit 0: high x, bit 1: high y, bit 2: high z
};
constexpr BoxFace kBoxFaces[] = {{"top", {4, 5, 7, 6}},  {"bottom", {0, 2, 3, 1}}, {"front", {0, 1, 5, 4}},
                                 {"back", {3, 2, 6, 7}}, {"left", {2, 0, 4, 6}},   {"right", {1, 3, 7, 5}}};

Loop cornersOf(const BoxFace& face, const Vector3d& low, const Vector3d& high) {
  Loop loop;
  for (const int corner : face.corners) {
    loop.emplace_back(corner & 1 ? high.x() : low.x(), corner & 2 ? high.y() : low.y(),
                      corner & 4 ? high.z() : low.z());
  }
  return loop;
}

}  // namespace

void MeshBuilder::addBox(int surface, const Vector3d& low, const Vector3d& high) {
  for (const BoxFace& face : kBoxFaces) addFace(surface, cornersOf(face, low, high));
}

void MeshBuilder::addBoxWithoutTop(int surface, const Vector3d& low, const Vector3d& high) {
  for (const BoxFace& face : kBoxFaces) {
    if (&face != &kBoxFaces[0]) addFace(surface, cornersOf(face, low, high));
  }
}

void MeshBuilder::addBoxOfPlanes(const std::string& part, SurfaceKind kind, const Material& material,
                                 const Vector3d& low, const Vector3d& high) {
  for (const BoxFace& face : kBoxFaces) addPlane(part + face.name, kind, material, cornersOf(face, low, high));
}

void MeshBuilder::addPrism(int surface, const std::vector<Vector2d>& outline, double low_z, double high_z) {
  Loop top, bottom;
  for (const Vector2d& p : outline) {
    top.emplace_back(p.x(), p.y(), high_z);
    bottom.emplace(bottom.begin(), p.x(), p.y(), low_z);
  }
  addFace(surface, top);
  addFace(surface, bottom);
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vector2d &a = outline[i], &b = outline[(i + 1) % outline.size()];
    addFace(surface, {{a.x(), a.y(), low_z}, {b.x(), b.y(), low_z}, {b.x(), b.y(), high_z}, {a.x(), a.y(), high_z}});
  }
}

void MeshBuilder::addRevolution(int surface, const std::vector<ProfilePoint>& profile, int sides) {
  if (profile.size() < 2 || sides < 3) throw std::invalid_argument(body_.name + ": a profile without an extent");
  // Lengths along the profile and its largest radius, for the texture.
  std::vector<double> along{0};
  double widest = 0;
  for (std::size_t i = 0; i < profile.size(); ++i) {
    widest = std::max(widest, profile[i].radius);
    if (i == 0) continue;
    along.push_back(along.back() +
                    std::hypot(profile[i].radius - profile[i - 1].radius, profile[i].z - profile[i - 1].z));
  }
  const Vector2d whole(2 * M_PI * widest, along.back());
  if (!(whole.minCoeff() > 0)) throw std::invalid_argument(body_.name + ": a profile without an extent");
  const Vector2d tile(layout_.tile.x() > 0 ? layout_.tile.x() : whole.x(),
                      layout_.tile.y() > 0 ? layout_.tile.y() : whole.y());

  const auto circle = [&](const ProfilePoint& at) {
    Loop loop;
    for (int i = 0; i < sides; ++i) {
      const double angle = 2 * M_PI * i / sides;
      loop.emplace_back(at.radius * std::cos(angle), at.radius * std::sin(angle), at.z);
    }
    return loop;
  };
  std::vector<std::vector<int>> rings;
  for (const ProfilePoint& point : profile) {
    rings.emplace_back();
    for (const Vector3d& p : circle(point)) rings.back().push_back(addVertex(p));
  }
  const auto corner = [&](Triangle& triangle, int i, std::size_t ring, int side) {
    triangle.corners[i] = rings[ring][side % sides];
    triangle.texture_at[i] = Vector2d(whole.x() * side / sides / tile.x(), along[ring] / tile.y()).cast<float>();
  };
  for (std::size_t k = 0; k + 1 < profile.size(); ++k) {
    for (int side = 0; side < sides; ++side) {
      Triangle lower, upper;
      lower.surface = upper.surface = surface;
      corner(lower, 0, k, side);
      corner(lower, 1, k, side + 1);
      corner(lower, 2, k + 1, side + 1);
      corner(upper, 0, k, side);
      corner(upper, 1, k + 1, side + 1);
      corner(upper, 2, k + 1, side);
      if (profile[k].radius > 0) body_.triangles.push_back(lower);
      if (profile[k + 1].radius > 0) body_.triangles.push_back(upper);
    }
  }
  if (profile.back().radius > 0) addFace(surface, circle(profile.back()));
  Loop bottom = circle(profile.front());
  std::reverse(bottom.begin(), bottom.end());
  if (profile.front().radius > 0) addFace(surface, bottom);
}

void MeshBuilder::addCylinder(int surface, double radius, double low_z, double high_z, int sides) {
  addRevolution(surface, {{radius, low_z}, {radius, high_z}}, sides);
}

void MeshBuilder::addCone(int surface, double radius, double low_z, double tip_z, int sides) {
  addRevolution(surface, {{radius, low_z}, {0, tip_z}}, sides);
}

void MeshBuilder::addSphere(int surface, double radius, int sides) {
  std::vector<ProfilePoint> profile;
  const int rings = std::max(2, sides / 2);
  for (int i = 0; i <= rings; ++i) {
    const double latitude = M_PI * i / rings - M_PI / 2;
    const bool pole = i == 0 || i == rings;
    profile.push_back({pole ? 0 : radius * std::cos(latitude), radius * std::sin(latitude)});
  }
  addRevolution(surface, profile, sides);
}

Body MeshBuilder::build() {
  Body body = std::move(body_);
  body_ = Body{};
  return body;
}

double areaOf(const PlanarFace& face) {
  double area = areaVector(face.outline_in_body).norm() / 2;
  for (const Loop& hole : face.holes_in_body) area -= areaVector(hole).norm() / 2;
  return area;
}

}  // namespace omnimapper::sim
