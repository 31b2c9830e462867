#pragma once

#include <omnimapper/geometry/Se3.h>

#include "omnimapper/graph/Variable.h"

namespace omnimapper::graph {

/// A kind of variable whose values are places in the map: poses, points, planes, walls.
class PlacedVariable : public Variable {
 public:
  /// Transforms x, given in frame b, to y, given in frame a [m, rad]. Both arrays are [ambientSize] and may be the
  /// same. For planar kinds, a_from_b must map the floor to itself.
  virtual void move(const geometry::Se3& a_from_b, const double* x, double* y) const = 0;
};

}  // namespace omnimapper::graph
