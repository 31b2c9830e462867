#pragma once

#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

namespace omnimapper::eval {

/// Triangles with shared corners.
struct TriangleMesh {
  std::vector<Eigen::Vector3d> vertices;      ///< [m]
  std::vector<std::array<int, 3>> triangles;  ///< indices of vertices, counter-clockwise seen from outside
};

/// Reads a binary, little-endian PLY of vertices and triangles. Vertices have float or double x, y and z; other scalar
/// properties are passed over. Throws base::Error(unreadable_input) naming the file if it is no such PLY, ends early,
/// or has a face that is no triangle or has a corner that does not exist.
TriangleMesh readTriangleMesh(const std::string& path);

}  // namespace omnimapper::eval
