#include "omnimapper/graph/PoseByPose.h"

#include <algorithm>

#include "omnimapper/graph/Between.h"

namespace omnimapper::graph {

namespace {

bool isPose(const VariableRecord& record) {
  return record.kind->kind() == Se2Kind::kName || record.kind->kind() == Se3Kind::kName;
}

}  // namespace

PoseByPose::PoseByPose(const Graph& whole) : whole_(whole) {
  std::map<base::VariableId, std::size_t> step_of;
  for (const auto& [id, record] : whole.variables()) {
    if (!isPose(record)) continue;
    step_of[id] = steps_.size();
    steps_.push_back({{id}, {}});
  }
  // A point comes with the first pose that a factor binds it to; what no pose is bound to comes with the first pose.
  std::map<base::VariableId, std::size_t> step_of_point;
  for (const auto& [id, record] : whole.factors()) {
    std::size_t last = 0;
    for (const auto variable : record.variables)
      if (const auto step = step_of.find(variable); step != step_of.end()) last = std::max(last, step->second);
    for (const auto variable : record.variables) {
      if (step_of.count(variable) > 0) continue;
      const auto place = step_of_point.emplace(variable, last).first;
      place->second = std::min(place->second, last);
    }
    if (last < steps_.size()) steps_[last].factors.push_back(id);
  }
  for (const auto& place : step_of_point)
    if (place.second < steps_.size()) steps_[place.second].variables.push_back(place.first);
}

Eigen::VectorXd PoseByPose::startOf(const Step& step, const IncrementalSolver& solver) const {
  const base::VariableId pose = step.variables.front();
  for (const auto id : step.factors) {
    const FactorRecord& edge = whole_.factor(id);
    if (edge.variables.size() != 2 || edge.variables[1] != pose || next_ == 0 ||
        edge.variables[0] != steps_[next_ - 1].variables.front())
      continue;
    const base::VariableId before = ids_.at(edge.variables[0]);
    const Eigen::VectorXd value = solver.contains(before) ? solver.value(before) : graph_.value(before);
    if (const auto* planar = dynamic_cast<const BetweenSe2*>(edge.factor.get()))
      return toValue(se2FromValue(value.data()) * planar->measured());
    if (const auto* spatial = dynamic_cast<const BetweenSe3*>(edge.factor.get()))
      if (value.size() == 7) return toValue(se3FromValue(value.data()) * spatial->measured());
  }
  return whole_.value(pose);
}

std::vector<base::FactorId> PoseByPose::grow(const IncrementalSolver& solver) {
  const Step& step = steps_.at(next_);
  for (const auto id : step.variables) {
    const VariableRecord& record = whole_.variable(id);
    const bool is_pose = id == step.variables.front();
    ids_[id] = graph_.addVariable(record.kind, is_pose ? startOf(step, solver) : record.value, record.fixed);
  }
  std::vector<base::FactorId> added;
  for (const auto id : step.factors) {
    FactorRecord record = whole_.factor(id);
    for (auto& variable : record.variables) variable = ids_.at(variable);
    added.push_back(graph_.addFactor(std::move(record)));
  }
  ++next_;
  return added;
}

}  // namespace omnimapper::graph
