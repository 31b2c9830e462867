#pragma once

#include "omnimapper/graph/Graph.h"

namespace omnimapper::graph {

/// Starting values for solve(), from the factors alone. Both set the poses (variables "se2" and "se3") by the Between
/// factors of positive weight, and then each point that a PointFactor binds to the mean of what its poses saw. Fixed
/// variables stay as they are; variables of other kinds too. In a connected part without fixed pose, the first pose of
/// a prior is set to what the prior measured, else the first pose stays.

/// Along the edges, each pose from one that is already set: over edges between ids that follow one another as far as
/// there are, then breadth first over the others. What odometry alone says.
void initialiseByChaining(Graph& graph);

/// Chordal relaxation: rotations first, as the linear least-squares solution over matrices, each then projected to the
/// nearest rotation; then translations, linear once the rotations are held. Both take the weights of the factors, not
/// their losses. Needs no start and finds the basin of the optimum where odometry misses it.
/// Source: Martinec and Pajdla, CVPR 2007; Carlone et al., ICRA 2015, "Initialization techniques for 3D SLAM".
void initialiseRotationsFirst(Graph& graph);

}  // namespace omnimapper::graph
