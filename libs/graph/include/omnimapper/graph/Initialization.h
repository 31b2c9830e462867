#pragma once

#include "omnimapper/graph/Graph.h"

namespace omnimapper::graph {

/// The two functions compute initial values for solve() from the factors alone. Both set the poses (variables "se2" and
/// "se3") by the Between factors of positive weight. Then each point with PointFactors is set to the mean of its
/// measurements, as seen from these poses. Fixed variables and variables of other kinds keep their values. In a
/// connected part without a fixed pose, the first pose that has a prior is set to it; if none has one, the first pose
/// keeps its value.

/// Sets each pose from a neighbour that is already set: first along the edges between consecutive ids, then breadth
/// first along the others. Without loop closures the result is plain odometry.
void initializeByChaining(Graph& graph);

/// Chordal relaxation: it solves for the rotations first, as a linear least-squares problem over matrices, and projects
/// each to the nearest rotation; then for the translations, which is linear with fixed rotations. Both steps use the
/// factors' weights, not their losses. It needs no initial values, and solve() usually converges from the result to the
/// optimum, even where it does not from odometry.
/// Source: Martinec and Pajdla, CVPR 2007; Carlone et al., ICRA 2015, "Initialization techniques for 3D SLAM".
void initializeRotationsFirst(Graph& graph);

}  // namespace omnimapper::graph
