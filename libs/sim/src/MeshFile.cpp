#include "MeshFile.h"

#include <omnimapper/surfaces/SurfaceClass.h>

#include <algorithm>
#include <cstdint>

namespace omnimapper::sim {

namespace {

template <class Number>
void put(std::ostream& out, Number number) {
  char bytes[sizeof(Number)];
  std::copy_n(reinterpret_cast<const char*>(&number), sizeof number, bytes);
  out.write(bytes, sizeof bytes);
}

void putVertex(std::ostream& out, const Eigen::Vector3d& vertex) {
  const Eigen::Vector3f rounded = vertex.cast<float>();
  for (int i = 0; i < 3; ++i) put(out, rounded[i]);
}

constexpr char kBegin[] = "ply\nformat binary_little_endian 1.0\n",
               kVertexProperties[] = "\nproperty float x\nproperty float y\nproperty float z\nelement face ",
               kFaceProperties[] = "\nproperty list uchar int vertex_indices\n";

bool hasArea(const Body& body, const Triangle& triangle) {
  const auto at = [&](int i) { return body.vertices_in_body[static_cast<std::size_t>(triangle.corners[i])]; };
  return (at(1) - at(0)).cross(at(2) - at(0)).norm() > 0;
}

}  // namespace

void writeMesh(std::ostream& out, const World& world) {
  std::size_t vertices = 0, faces = 0;
  for (const Body& body : world.bodies) {
    if (!body.track.at(0)) continue;
    vertices += body.vertices_in_body.size();
    faces += body.triangles.size();
  }
  out << kBegin << "comment frame: map, z up; metres\n";
  const auto& classes = surfaces::allSurfaceClasses();
  for (std::size_t i = 0; i < classes.size(); ++i) out << "comment class " << i << ": " << toString(classes[i]) << "\n";
  out << "element vertex " << vertices << kVertexProperties << faces << kFaceProperties
      << "property int surface\nproperty uchar class\nend_header\n";
  for (const Body& body : world.bodies) {
    const auto map_from_body = body.track.at(0);
    if (!map_from_body) continue;
    for (const auto& vertex : body.vertices_in_body) putVertex(out, *map_from_body * vertex);
  }
  int first_vertex = 0, first_surface = 1;
  for (const Body& body : world.bodies) {
    if (body.track.at(0)) {
      for (const Triangle& triangle : body.triangles) {
        put(out, std::uint8_t{3});
        for (const int corner : triangle.corners) put(out, std::int32_t{first_vertex + corner});
        put(out, std::int32_t{first_surface + triangle.surface});
        const auto is = body.surfaces[static_cast<std::size_t>(triangle.surface)].is;
        put(out, static_cast<std::uint8_t>(std::find(classes.begin(), classes.end(), is) - classes.begin()));
      }
      first_vertex += static_cast<int>(body.vertices_in_body.size());
    }
    first_surface += static_cast<int>(body.surfaces.size());
  }
}

void writeMesh(std::ostream& out, const Body& body) {
  std::vector<const Triangle*> triangles;
  for (const Triangle& triangle : body.triangles) {
    if (hasArea(body, triangle)) triangles.push_back(&triangle);
  }
  out << kBegin
      << "comment frame: of the object, origin in the middle of its lowest face, z up; metres\nelement vertex "
      << body.vertices_in_body.size() << kVertexProperties << triangles.size() << kFaceProperties << "end_header\n";
  for (const Eigen::Vector3d& vertex : body.vertices_in_body) putVertex(out, vertex);
  for (const Triangle* triangle : triangles) {
    put(out, std::uint8_t{3});
    for (const int corner : triangle->corners) put(out, std::int32_t{corner});
  }
}

}  // namespace omnimapper::sim
