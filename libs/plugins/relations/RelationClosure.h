#pragma once

#include <set>
#include <string_view>
#include <utility>
#include <vector>

#include "Relations.h"

namespace omnimapper::plugins {

/// Disjoint groups of landmarks, which are identified by their variables.
class VariableGroups {
 public:
  /// The member that represents the group of `id`: the same one for all members of a group.
  base::VariableId representativeOf(base::VariableId id) const;
  bool inOneGroup(base::VariableId a, base::VariableId b) const { return representativeOf(a) == representativeOf(b); }
  void join(base::VariableId a, base::VariableId b);

 private:
  std::map<base::VariableId, base::VariableId> parents_;
};

/// The accepted relations and all that follows from them, so that no relation is stated twice. Which walls lie on one
/// line is recorded apart from which are parallel, because parallel walls may lie on different lines.
class RelationClosure {
 public:
  explicit RelationClosure(const KnownRelations& known);

  /// Whether a relation already places the point on a surface.
  bool isPlaced(base::VariableId point) const { return placed_.count(point) > 0; }
  /// Whether the angle between two walls is already determined; for planes, whether they are already known to be
  /// parallel.
  bool isAngleKnown(base::VariableId a, base::VariableId b) const { return same_angle_.inOneGroup(a, b); }
  /// Whether two planes are already known to be perpendicular.
  bool areSquare(base::VariableId a, base::VariableId b) const;
  /// Whether two walls are already known to lie on one line, or two planes on one plane.
  bool isAligned(base::VariableId a, base::VariableId b) const { return aligned_.inOneGroup(a, b); }

  /// Adds a relation of this kind. Returns false, without adding it, if a part of what it states is already known.
  bool add(std::string_view kind, base::VariableId a, base::VariableId b);

 private:
  std::set<base::VariableId> placed_;
  VariableGroups same_angle_, aligned_;
  std::vector<std::pair<base::VariableId, base::VariableId>> square_;
};

}  // namespace omnimapper::plugins
