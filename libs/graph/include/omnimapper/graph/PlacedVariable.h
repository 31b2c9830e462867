#pragma once

#include <omnimapper/geometry/Se3.h>

#include "omnimapper/graph/Variable.h"

namespace omnimapper::graph {

/// A kind of variable whose values are places in the map: poses, points, planes, walls.
class PlacedVariable : public Variable {
 public:
  /// The place y in frame a that is x in frame b [m, rad]. x, y [ambientSize]; y may be x. Planar kinds need an
  /// a_from_b that keeps the floor where it is.
  virtual void move(const geometry::Se3& a_from_b, const double* x, double* y) const = 0;
};

}  // namespace omnimapper::graph
