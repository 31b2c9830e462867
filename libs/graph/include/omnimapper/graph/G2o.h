#pragma once

#include <cstdint>
#include <iosfwd>
#include <map>
#include <string>

#include "omnimapper/graph/Graph.h"

namespace omnimapper::graph {

/// A graph from a .g2o file, and what its vertices were called there.
struct G2oContent {
  Graph graph;
  std::map<std::int64_t, base::VariableId> ids;
  std::size_t left_out = 0;  ///< lines that speak of lines and planes
};

/// Reads VERTEX_SE2, VERTEX_SE3:QUAT, VERTEX_XY, VERTEX_TRACKXYZ, EDGE_SE2, EDGE_SE3:QUAT, EDGE_SE2_XY,
/// EDGE_SE3_TRACKXYZ, EDGE_PRIOR_SE2, EDGE_SE3_PRIOR, PARAMS_SE3OFFSET and FIX. Information is converted to ours
/// (geometry/Conversions.h). Vertices that only edges name are made, with values from initialiseByChaining(). Where
/// nothing is fixed and there is no prior, the vertex of the lowest number that is a pose is fixed. VERTEX_LINE2D,
/// VERTEX_PLANE, EDGE_SE2_LINE2D and EDGE_SE3_PLANE_CALIB are left out and counted.
/// Throws Error(unreadable_input) if the file is missing, Error(damaged_input) with file and line on anything else.
G2oContent readG2o(const std::string& path);
/// The same from a stream; `name` stands in messages.
G2oContent readG2o(std::istream& in, const std::string& name);

/// Writes the poses, points, Between, Prior and Point factors of a graph; values and measurements keep every bit, and a
/// factor's weight goes into its information (of weight 0: left out). Other factors of a pose and a point, such as
/// ranges and bearings, and factors of a pose and a hyperplane (Variable.h) are written to first order at the values as
/// they are: as EDGE_SE2_LINE2D from poses on the floor, to walls and to planes that lean by less than 10 deg, and as
/// EDGE_SE3_PLANE_CALIB from poses in space. What the format cannot hold (other kinds, other factors of lifted poses,
/// losses) is counted in comments at the top. Vertices are numbered from 0 in the order of ids; where there are planes,
/// the last one is the sensor's pose in the base that their edges ask for, fixed at the base itself.
void writeG2o(const Graph& graph, std::ostream& out);
/// The same into a file, whole or not at all. Throws as base::writeFile().
void writeG2o(const Graph& graph, const std::string& path);

/// Chi-square as g2o counts it: sum of weight * e^T information e, where the rotation part of e of SE(3) is the vector
/// part of the unit quaternion (in g2o's own scaling of the information). Losses do not enter.
double g2oChi2(const Graph& graph);

}  // namespace omnimapper::graph
