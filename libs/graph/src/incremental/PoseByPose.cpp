#include "omnimapper/graph/PoseByPose.h"

#include <algorithm>
#include <optional>
#include <set>

#include "omnimapper/graph/Between.h"

namespace omnimapper::graph {

namespace {

bool isPose(const VariableRecord& record) {
  return record.kind->kind() == Se2Kind::kName || record.kind->kind() == Se3Kind::kName;
}

/// Poses that are fixed or have a factor of their own, and from there always the lowest one that an edge leads to, so
/// that each is held by what is there already. Those that no edge leads to come last.
std::vector<base::VariableId> orderOfPoses(const Graph& graph) {
  std::set<base::VariableId> open, known;
  const auto reach = [&](base::VariableId id) {
    if (isPose(graph.variable(id)) && known.insert(id).second) open.insert(id);
  };
  for (const auto& [id, record] : graph.variables())
    if (record.fixed) reach(id);
  for (const auto& [id, record] : graph.factors())
    if (record.weight > 0 && record.variables.size() == 1) reach(record.variables[0]);
  std::vector<base::VariableId> order;
  while (!open.empty()) {
    const base::VariableId pose = *open.begin();
    open.erase(open.begin());
    order.push_back(pose);
    for (const auto factor : graph.factorsOf(pose))
      if (graph.factor(factor).weight > 0)
        for (const auto other : graph.factor(factor).variables) reach(other);
  }
  for (const auto& [id, record] : graph.variables())
    if (isPose(record) && known.count(id) == 0) order.push_back(id);
  return order;
}

/// The pose at the other end of an edge whose one end has this value; none if it is no edge between poses of one kind.
std::optional<Eigen::VectorXd> otherEnd(const Factor& edge, const Eigen::VectorXd& value, bool is_start) {
  if (const auto* planar = dynamic_cast<const BetweenSe2*>(&edge)) {
    const auto motion = is_start ? planar->measured() : geometry::inverse(planar->measured());
    return toValue(se2FromValue(value.data()) * motion);
  }
  const auto* spatial = dynamic_cast<const BetweenSe3*>(&edge);
  if (!spatial || value.size() != se3()->ambientSize()) return std::nullopt;
  const auto motion = is_start ? spatial->measured() : geometry::inverse(spatial->measured());
  return toValue(se3FromValue(value.data()) * motion);
}

}  // namespace

PoseByPose::PoseByPose(const Graph& whole) : whole_(whole) {
  std::map<base::VariableId, std::size_t> step_of;
  for (const auto id : orderOfPoses(whole)) {
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
  std::optional<Eigen::VectorXd> start;
  for (const auto id : step.factors) {
    const FactorRecord& edge = whole_.factor(id);
    if (edge.variables.size() != 2) continue;
    const bool is_end = edge.variables[1] == pose;
    const base::VariableId from = edge.variables[is_end ? 0 : 1];
    const auto there = ids_.find(from);
    if (there == ids_.end()) continue;
    const bool is_before = from == steps_[next_ - 1].variables.front();
    if (start && !is_before) continue;
    const base::VariableId here = there->second;
    const auto found = otherEnd(*edge.factor, solver.contains(here) ? solver.value(here) : graph_.value(here), is_end);
    if (found && found->size() == whole_.value(pose).size()) start = found;
    if (found && is_before) break;
  }
  return start ? *start : whole_.value(pose);
}

std::vector<base::FactorId> PoseByPose::grow(const IncrementalSolver& solver) {
  const Step& step = steps_.at(next_);
  for (const auto id : step.variables) {
    const VariableRecord& record = whole_.variable(id);
    const bool is_pose = id == step.variables.front();
    const bool starts_anew = !is_pose || record.fixed || next_ == 0;
    ids_[id] = graph_.addVariable(record.kind, starts_anew ? record.value : startOf(step, solver), record.fixed);
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
