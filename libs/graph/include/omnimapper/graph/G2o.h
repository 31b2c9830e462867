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
  std::size_t left_out = 0;  ///< lines of the file that describe lines or planes; they are not read
};

/// Reads VERTEX_SE2, VERTEX_SE3:QUAT, VERTEX_XY, VERTEX_TRACKXYZ, EDGE_SE2, EDGE_SE3:QUAT, EDGE_SE2_XY,
/// EDGE_SE3_TRACKXYZ, EDGE_PRIOR_SE2, EDGE_SE3_PRIOR, PARAMS_SE3OFFSET and FIX. Information matrices are converted to
/// our tangents (geometry/Conversions.h). A vertex that only edges name is added, with a value from
/// initializeByChaining(). If nothing is fixed and there is no prior, the pose with the lowest vertex number is fixed.
/// VERTEX_LINE2D, VERTEX_PLANE, EDGE_SE2_LINE2D and EDGE_SE3_PLANE_CALIB are left out and counted.
/// Throws Error(unreadable_input) if the file is missing, Error(damaged_input) with file and line on anything else.
G2oContent readG2o(const std::string& path);
/// The same from a stream; `name` is used in error messages.
G2oContent readG2o(std::istream& in, const std::string& name);

/// Writes the poses, points, Between, Prior and Point factors of a graph. Values and measurements keep every bit, and a
/// factor's weight is multiplied into its information (factors of weight 0 are left out). Other factors of a pose and a
/// point, such as ranges and bearings, and factors of a pose and a hyperplane (Variable.h) are linearized at the
/// current values. Hyperplane factors become EDGE_SE2_LINE2D if the pose is planar and the hyperplane is a wall or a
/// plane less than 10 deg from vertical, and EDGE_SE3_PLANE_CALIB if the pose is in space. What the format cannot hold
/// (other kinds, other factors of lifted poses, losses) is counted in comments at the top. Vertices are numbered from 0
/// in the order of ids. If there are planes, the last vertex is the sensor's pose in the base, which their edges
/// require: it is fixed at the base itself.
void writeG2o(const Graph& graph, std::ostream& out);
/// Writes the same into a file, whole or not at all. Throws as base::writeFile().
void writeG2o(const Graph& graph, const std::string& path);

/// Chi-square as g2o computes it: sum of weight * e^T information e, where the rotation part of an SE(3) error e is the
/// vector part of the unit quaternion (in g2o's own scaling of the information). Losses are not applied.
double g2oChi2(const Graph& graph);

}  // namespace omnimapper::graph
