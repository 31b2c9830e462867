#pragma once

#include <omnimapper/geometry/Se3.h>

#include <unordered_map>
#include <vector>

#include "omnimapper/graph/Graph.h"

namespace omnimapper::graph {

/// The poses of a graph and the Between and Prior factors on them, all in SE(3): the input of the initializations.
struct PoseEdges {
  struct Pose {
    base::VariableId id;
    geometry::Se3 map_from_pose;
    bool planar;
    bool fixed;
  };
  struct Edge {
    int a, b;  // indices in poses
    geometry::Se3 a_from_b;
    geometry::Matrix6d information;  // of a planar edge: the mean of x and y for z, that of yaw for roll and pitch
  };
  struct Prior {
    int pose;
    geometry::Se3 map_from_pose;
    geometry::Matrix6d information;
  };
  std::vector<Pose> poses;  // in the order of ids
  std::vector<Edge> edges;
  std::vector<Prior> priors;
  std::unordered_map<base::VariableId, int> index;
};

PoseEdges poseEdges(const Graph& graph);

/// Writes back the poses that are not fixed, and sets the points (see Initialization.h).
void storePoses(const PoseEdges& edges, Graph& graph);

}  // namespace omnimapper::graph
