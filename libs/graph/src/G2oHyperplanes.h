#pragma once

#include <Eigen/Core>

#include "omnimapper/graph/Graph.h"

/// Lines and planes as g2o writes them: with their distance from the origin along the normal, which is our -d.
namespace omnimapper::graph::g2o {

/// A factor of a pose and a hyperplane, to first order: with the same information, and the same gradient at the current
/// values.
struct HyperplaneEdge {
  Eigen::VectorXd measured;     ///< in the base: a line (heading of its normal [rad], distance [m]), or a plane (nx ny
                                ///< nz d), as EDGE_SE2_LINE2D and EDGE_SE3_PLANE_CALIB take them
  Eigen::MatrixXd information;  ///< of g2o's error: heading, distance; or azimuth, elevation, distance
};

/// The line in which a hyperplane meets the floor: heading of its normal [rad], distance [m]. `hyperplane` is (nx ny d)
/// or an upright (nx ny nz d).
Eigen::Vector2d lineOf(const Eigen::VectorXd& hyperplane);
/// Whether a hyperplane has such a line: its tilt from upright is less than 10 deg.
bool hasLine(const Eigen::VectorXd& hyperplane);

/// `record` binds an se2 pose, then a hyperplane that has a line.
HyperplaneEdge lineEdge(const Graph& graph, const FactorRecord& record);
/// `record` binds an se3 pose, then a plane of space.
HyperplaneEdge planeEdge(const Graph& graph, const FactorRecord& record);

}  // namespace omnimapper::graph::g2o
