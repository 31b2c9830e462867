#pragma once

#include "omnimapper/graph/Graph.h"

namespace omnimapper::graph {

/// The two functions compute initial values for solve() from the factors alone. Both set the poses (variables "se2" and
/// "se3") by the Between factors of positive weight. Then each point with PointFactors is set to the mean of its
/// measurements, as seen from these poses. Fixed variables and variables of other kinds keep their values. In a
/// connected part without a fixed pose, the pose with the first prior is set to that prior. If there is no prior
/// either, the first pose keeps its value.

/// Sets each pose from a neighbour that is already set: first along the edges between consecutive ids, then breadth
/// first along the others. Without loop closures the result is plain odometry.
void initializeByChaining(Graph& graph);

/// Chordal relaxation. First it solves for the rotations, as a linear least-squares problem over matrices, and replaces
/// each matrix by the nearest rotation. Then it solves for the translations, which is a linear problem once the
/// rotations are fixed. Both steps use the factors' weights, but not their losses. It needs no initial values. From the
/// result solve() usually converges to the optimum, even where it does not from odometry. Source: Martinec and Pajdla,
/// CVPR 2007; Carlone et al., ICRA 2015, "Initialization techniques for 3D SLAM".
void initializeRotationsFirst(Graph& graph);

}  // namespace omnimapper::graph
