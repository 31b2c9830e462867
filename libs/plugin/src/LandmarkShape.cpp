#include <omnimapper/plugin/LandmarkShape.h>

#include <vector>

namespace omnimapper::mapper {

namespace {

// None unless the graph has all of them: a shape of half its variables would be a guess.
std::vector<Eigen::VectorXd> valuesOf(const map::Landmark& landmark, const graph::Graph& graph) {
  std::vector<Eigen::VectorXd> values;
  for (const auto id : landmark.variables) {
    if (!graph.contains(id)) return {};
    values.push_back(graph.value(id));
  }
  return values;
}

}  // namespace

map::LandmarkShape shapeOf(const map::Landmark& landmark, const State& state) {
  map::LandmarkShape shape;
  if (landmark.payload) shape = landmark.payload->shape(valuesOf(landmark, state.graph), state.map.key_frames);
  if (shape.label.empty()) shape.label = landmark.kind.empty() ? "landmark" : landmark.kind;
  return shape;
}

std::map<std::string, std::size_t> countLandmarks(const State& state) {
  std::map<std::string, std::size_t> counts;
  for (const auto& [id, landmark] : state.map.landmarks) {
    if (landmark.state != map::Landmark::State::active) continue;
    const map::LandmarkShape shape = shapeOf(landmark, state);
    if (shape.is_candidate) continue;
    const std::string &label = shape.label, named = landmark.kind + " ";
    ++counts[label.compare(0, named.size(), named) == 0 ? landmark.kind : label];
  }
  return counts;
}

}  // namespace omnimapper::mapper
