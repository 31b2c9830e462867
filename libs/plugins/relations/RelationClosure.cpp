#include "RelationClosure.h"

#include <algorithm>

namespace omnimapper::plugins {

namespace {

bool placesPoint(std::string_view kind) {
  return kind == "point_on_wall" || kind == "point3_on_wall" || kind == "point_on_plane";
}

bool determinesAngle(std::string_view kind) {
  return kind == "wall_turn" || kind == "planes_parallel" || kind == "walls_aligned" || kind == "planes_aligned";
}

bool determinesLine(std::string_view kind) {
  return kind == "walls_aligned" || kind == "planes_aligned" || kind == "wall_shift" || kind == "plane_shift";
}

}  // namespace

base::VariableId VariableGroups::representativeOf(base::VariableId id) const {
  for (auto up = parents_.find(id); up != parents_.end(); up = parents_.find(id)) id = up->second;
  return id;
}

void VariableGroups::join(base::VariableId a, base::VariableId b) {
  const auto root_a = representativeOf(a), root_b = representativeOf(b);
  if (root_a != root_b) parents_[std::max(root_a, root_b)] = std::min(root_a, root_b);
}

RelationClosure::RelationClosure(const KnownRelations& known) {
  for (const auto& [pair, acts] : known) {
    if (!acts) continue;
    const auto& [kind, ids] = pair;
    if (placesPoint(kind)) placed_.insert({ids.first, ids.second});  // which of them is the point does not matter
    if (determinesAngle(kind)) same_angle_.join(ids.first, ids.second);
    if (determinesLine(kind)) aligned_.join(ids.first, ids.second);
    if (kind == "planes_square") square_.push_back(ids);
  }
}

// A plane that is parallel to one of two perpendicular planes is perpendicular to the other.
bool RelationClosure::areSquare(base::VariableId a, base::VariableId b) const {
  const auto group_a = same_angle_.representativeOf(a), group_b = same_angle_.representativeOf(b);
  return std::any_of(square_.begin(), square_.end(), [&](const auto& pair) {
    const auto first = same_angle_.representativeOf(pair.first), second = same_angle_.representativeOf(pair.second);
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
  if ((determinesAngle(kind) && isAngleKnown(a, b)) || (determinesLine(kind) && isAligned(a, b))) return false;
  if (determinesAngle(kind)) same_angle_.join(a, b);
  if (determinesLine(kind)) aligned_.join(a, b);
  return true;
}

}  // namespace omnimapper::plugins
