#pragma once

#include <cstdint>
#include <iosfwd>
#include <map>
#include <string>

#include "omnimapper/graph/Graph.h"

namespace omnimapper::graph {

/// A graph from a .g2o file, and the variable for each vertex number of the file.
struct G2oContent {
  Graph graph;
  std::map<std::int64_t, base::VariableId> ids;
  std::size_t left_out = 0;  ///< number of rows of the file that describe lines or planes, which are not read
  std::size_t repaired = 0;  ///< number of edges whose information matrix was not positive definite
  int first_repaired = 0;    ///< the line of the first of them
};

/// Reads VERTEX_SE2, VERTEX_SE3:QUAT, VERTEX_XY, VERTEX_TRACKXYZ, EDGE_SE2, EDGE_SE3:QUAT, EDGE_SE2_XY,
/// EDGE_SE3_TRACKXYZ, EDGE_PRIOR_SE2, EDGE_SE3_PRIOR, PARAMS_SE3OFFSET and FIX. Information matrices are converted to
/// our tangents (geometry/Conversions.h). One that is not positive definite is replaced by the nearest matrix whose
/// smallest eigenvalue is a billionth of its largest, and counted; other programs write such ones, and read them. A
/// vertex that is named by edges only is added, with a value from initializeByChaining(). If nothing is fixed and there
/// is no prior, the pose with the lowest vertex number is fixed. VERTEX_LINE2D, VERTEX_PLANE, EDGE_SE2_LINE2D and
/// EDGE_SE3_PLANE_CALIB are left out and counted. Throws Error(unreadable_input) if the file is missing, and
/// Error(damaged_input) with file and line for anything else that is wrong.
G2oContent readG2o(const std::string& path);
/// Reads the same from a stream; `name` is used in error messages.
G2oContent readG2o(std::istream& in, const std::string& name);

/// Writes the poses, points, Between, Prior and Point factors of a graph. Values and measurements keep every bit. A
/// factor's weight is multiplied into its information; factors of weight 0 are left out. Other factors that bind a pose
/// and a point, such as ranges and bearings, and factors that bind a pose and a hyperplane (Variable.h) are linearized
/// at the current values. A factor of a hyperplane becomes an EDGE_SE2_LINE2D if the pose is planar and the hyperplane
/// is a wall or a plane less than 10 deg from vertical; it becomes an EDGE_SE3_PLANE_CALIB if the pose is in space.
/// What the format cannot hold is left out and counted in comments at the top: other kinds, losses, and those factors
/// without a hyperplane that take a pose in space but bind a planar one. Vertices are numbered from 0 in the order of
/// ids. If there are planes, one more vertex is written last and fixed: the sensor's pose in the base, which edges to
/// planes require; it is the identity.
void writeG2o(const Graph& graph, std::ostream& out);
/// Writes the same into a file, as a whole or not at all. Throws as base::writeFile() does.
void writeG2o(const Graph& graph, const std::string& path);

/// Chi-square as g2o computes it: the sum of weight * e^T information e. The rotation part of an SE(3) error e is the
/// vector part of the unit quaternion, and `information` is scaled accordingly. Losses are not applied.
double g2oChi2(const Graph& graph);

}  // namespace omnimapper::graph
