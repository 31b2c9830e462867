#pragma once

#include <set>
#include <string_view>
#include <utility>
#include <vector>

#include "Relations.h"

namespace omnimapper::plugins {

/// Landmarks in groups, by their variables.
class VariableGroups {
 public:
  /// The same for all of a group.
  base::VariableId nameOf(base::VariableId id) const;
  bool areOne(base::VariableId a, base::VariableId b) const { return nameOf(a) == nameOf(b); }
  void join(base::VariableId a, base::VariableId b);

 private:
  std::map<base::VariableId, base::VariableId> parents_;
};

/// What acting relations tell of directions, lines and points, with all that follows from it: nothing is to be told
/// twice. A line is told beside its direction, for walls in parallel may be on one line or not.
class RelationClosure {
 public:
  explicit RelationClosure(const KnownRelations& known);

  /// Whether the point is on something.
  bool isPlaced(base::VariableId point) const { return placed_.count(point) > 0; }
  /// Whether the turn from one wall to the other is told; of planes, that they are parallel.
  bool isTurned(base::VariableId a, base::VariableId b) const { return turned_.areOne(a, b); }
  /// Whether it is told that two planes are at a right angle.
  bool areSquare(base::VariableId a, base::VariableId b) const;
  /// Whether it is told that they are on one line, or one plane.
  bool isAligned(base::VariableId a, base::VariableId b) const { return aligned_.areOne(a, b); }

  /// Takes in a relation of the kind, unless some of what it says is told: then false.
  bool add(std::string_view kind, base::VariableId a, base::VariableId b);

 private:
  std::set<base::VariableId> placed_;
  VariableGroups turned_, aligned_;
  std::vector<std::pair<base::VariableId, base::VariableId>> square_;
};

}  // namespace omnimapper::plugins
