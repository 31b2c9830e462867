#include "RelationClosure.h"

#include <algorithm>

namespace omnimapper::plugins {

namespace {

bool placesPoint(std::string_view kind) {
  return kind == "point_on_wall" || kind == "point3_on_wall" || kind == "point_on_plane";
}

bool tellsTurn(std::string_view kind) {
  return kind == "wall_turn" || kind == "planes_parallel" || kind == "walls_aligned" || kind == "planes_aligned";
}

bool tellsLine(std::string_view kind) {
  return kind == "walls_aligned" || kind == "planes_aligned" || kind == "wall_shift" || kind == "plane_shift";
}

}  // namespace

base::VariableId VariableGroups::nameOf(base::VariableId id) const {
  for (auto up = parents_.find(id); up != parents_.end(); up = parents_.find(id)) id = up->second;
  return id;
}

void VariableGroups::join(base::VariableId a, base::VariableId b) {
  const auto name_a = nameOf(a), name_b = nameOf(b);
  if (name_a != name_b) parents_[std::max(name_a, name_b)] = std::min(name_a, name_b);
}

RelationClosure::RelationClosure(const KnownRelations& known) {
  for (const auto& [pair, acts] : known) {
    if (!acts) continue;
    const auto& [kind, ids] = pair;
    if (placesPoint(kind)) placed_.insert({ids.first, ids.second});  // which of them is the point does not matter
    if (tellsTurn(kind)) turned_.join(ids.first, ids.second);
    if (tellsLine(kind)) aligned_.join(ids.first, ids.second);
    if (kind == "planes_square") square_.push_back(ids);
  }
}

// What is parallel to one of two planes is at a right angle to the other.
bool RelationClosure::areSquare(base::VariableId a, base::VariableId b) const {
  const auto group_a = turned_.nameOf(a), group_b = turned_.nameOf(b);
  return std::any_of(square_.begin(), square_.end(), [&](const auto& told) {
    const auto first = turned_.nameOf(told.first), second = turned_.nameOf(told.second);
    return (first == group_a && second == group_b) || (first == group_b && second == group_a);
  });
}

bool RelationClosure::add(std::string_view kind, base::VariableId a, base::VariableId b) {
  if (placesPoint(kind)) return placed_.insert(a).second;
  if (kind == "planes_square") {
    if (areSquare(a, b)) return false;
    square_.emplace_back(a, b);
    return true;
  }
  if ((tellsTurn(kind) && isTurned(a, b)) || (tellsLine(kind) && isAligned(a, b))) return false;
  if (tellsTurn(kind)) turned_.join(a, b);
  if (tellsLine(kind)) aligned_.join(a, b);
  return true;
}

}  // namespace omnimapper::plugins
