#include <omnimapper/map/Corrections.h>
#include <omnimapper/plugin/LandmarkShape.h>

#include <cmath>
#include <optional>
#include <vector>

namespace omnimapper::mapper {

namespace {

// Empty unless the graph has all variables of the landmark: a shape from some of them would be a guess.
std::vector<Eigen::VectorXd> valuesOf(const map::Landmark& landmark, const graph::Graph& graph) {
  std::vector<Eigen::VectorXd> values;
  for (const auto id : landmark.variables) {
    if (!graph.contains(id)) return {};
    values.push_back(graph.value(id));
  }
  return values;
}

// The normal of the plane or wall that a factor binds together with the landmark, on the side of `towards`.
std::optional<Eigen::Vector3d> normalOfSurface(const map::Landmark& landmark, const graph::Graph& graph,
                                               const Eigen::Vector3d& towards) {
  constexpr double kFacing = 0.3;  // smallest cosine between the surface's normal and `towards`
  if (landmark.variables.size() != 1 || !graph.contains(landmark.variables.front())) return std::nullopt;
  for (const auto factor : graph.factorsOf(landmark.variables.front())) {
    const auto& record = graph.factor(factor);
    if (!(record.weight > 0)) continue;
    for (const auto id : record.variables) {
      const Eigen::VectorXd plane = graph.variable(id).kind->hyperplane(graph.value(id).data());
      if (plane.size() == 0) continue;
      Eigen::Vector3d normal = Eigen::Vector3d::Zero();  // level for a wall, whose hyperplane is a line on the floor
      normal.head(plane.size() - 1) = plane.head(plane.size() - 1);
      normal.normalize();
      const double facing = normal.dot(towards.normalized());
      if (std::abs(facing) > kFacing) return facing < 0 ? Eigen::Vector3d(-normal) : normal;
    }
  }
  return std::nullopt;
}

}  // namespace

map::LandmarkShape shapeOf(const map::Landmark& landmark, const State& state) {
  map::LandmarkShape shape;
  if (landmark.payload) shape = landmark.payload->shape(valuesOf(landmark, state.graph), state.map.key_frames);
  if (shape.normal && shape.points.size() == 1 && shape.surfaces.empty()) {
    if (const auto normal = normalOfSurface(landmark, state.graph, *shape.normal)) shape.normal = normal;
  }
  if (shape.label.empty()) shape.label = landmark.kind.empty() ? "landmark" : landmark.kind;
  return shape;
}

std::map<std::string, std::size_t> countLandmarks(const State& state) {
  std::map<std::string, std::size_t> counts;
  const auto deleted = map::deletedLandmarks(state.map);
  for (const auto& [id, landmark] : state.map.landmarks) {
    if (landmark.state != map::Landmark::State::active || deleted.count(id) > 0) continue;
    const map::LandmarkShape shape = shapeOf(landmark, state);
    if (shape.is_candidate) continue;
    const std::string &label = shape.label, named = landmark.kind + " ";
    ++counts[label.compare(0, named.size(), named) == 0 ? landmark.kind : label];
  }
  return counts;
}

}  // namespace omnimapper::mapper
