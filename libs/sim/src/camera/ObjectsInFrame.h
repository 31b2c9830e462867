#pragma once

#include <omnimapper/sim/ObjectView.h>

#include <functional>
#include <vector>

#include "Frame.h"

namespace omnimapper::sim {

/// Finds the objects of a world in images.
class ObjectsInFrame {
 public:
  explicit ObjectsInFrame(const World& world);

  /// The objects that at least one pixel shows, in the order of World::objects. `hasDepth` says whether the range image
  /// has a depth at a column and row.
  std::vector<ObjectView> find(const Frame& frame, const std::function<bool(int column, int row)>& hasDepth) const;

 private:
  std::size_t objects_;
  std::vector<int> object_of_surface_;  // by the number of the surface; -1: none
};

}  // namespace omnimapper::sim
