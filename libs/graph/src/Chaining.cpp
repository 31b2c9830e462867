#include <deque>
#include <vector>

#include "PoseEdges.h"
#include "omnimapper/graph/Initialization.h"

namespace omnimapper::graph {

namespace {

using geometry::Se3;

/// Sets poses outward from those that are set, along edges between neighbours in the order of ids first.
class Chain {
 public:
  explicit Chain(PoseEdges& edges) : edges_(edges), set_(edges.poses.size(), false), edges_of_(edges.poses.size()) {
    for (const PoseEdges::Edge& edge : edges.edges) {
      edges_of_[edge.a].push_back(&edge);
      edges_of_[edge.b].push_back(&edge);
    }
  }

  bool isSet(int pose) const { return set_[pose]; }
  void anchor(int pose) {
    set_[pose] = true;
    open_.push_back({pose, nullptr});
  }
  /// Sets poses until no more can be reached.
  void spread() {
    while (!open_.empty()) {
      const Step step = open_.front();
      open_.pop_front();
      if (step.edge && set_[step.pose]) continue;
      if (step.edge) follow(step);
      for (const PoseEdges::Edge* edge : edges_of_[step.pose]) {
        const int next = edge->a == step.pose ? edge->b : edge->a;
        if (set_[next]) continue;
        if (std::abs(next - step.pose) == 1)
          open_.push_front({next, edge});
        else
          open_.push_back({next, edge});
      }
    }
  }

 private:
  struct Step {
    int pose;                     // to set
    const PoseEdges::Edge* edge;  // from a pose that is set; none for an anchor
  };
  void follow(const Step& step) {
    const PoseEdges::Edge& edge = *step.edge;
    edges_.poses[step.pose].map_from_pose = edge.b == step.pose
                                                ? edges_.poses[edge.a].map_from_pose * edge.a_from_b
                                                : edges_.poses[edge.b].map_from_pose * geometry::inverse(edge.a_from_b);
    set_[step.pose] = true;
  }

  PoseEdges& edges_;
  std::vector<bool> set_;
  std::vector<std::vector<const PoseEdges::Edge*>> edges_of_;
  std::deque<Step> open_;
};

}  // namespace

void initializeByChaining(Graph& graph) {
  PoseEdges edges = poseEdges(graph);
  Chain chain(edges);
  for (std::size_t i = 0; i < edges.poses.size(); ++i)
    if (edges.poses[i].fixed) chain.anchor(static_cast<int>(i));
  chain.spread();
  for (const PoseEdges::Prior& prior : edges.priors) {
    if (chain.isSet(prior.pose)) continue;
    edges.poses[prior.pose].map_from_pose = prior.map_from_pose;
    chain.anchor(prior.pose);
    chain.spread();
  }
  for (std::size_t i = 0; i < edges.poses.size(); ++i) {
    if (chain.isSet(static_cast<int>(i))) continue;
    chain.anchor(static_cast<int>(i));
    chain.spread();
  }
  storePoses(edges, graph);
}

}  // namespace omnimapper::graph
