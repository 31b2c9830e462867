#pragma once

#include <omnimapper/sim_world/Building.h>
#include <omnimapper/sim_world/SignMaking.h>
#include <omnimapper/sim_world/WorldPlan.h>

#include <string>
#include <vector>

namespace omnimapper::sim {

/// Names used in plans: "dark", "white", "exit", and "poster", "notice", ... in the order of SignStyle and PosterKind.
const std::vector<std::string>& signStyleNames();
const std::vector<std::string>& posterKindNames();
/// The style with one of signStyleNames().
SignStyle signStyleOf(const std::string& name);

/// The items that hang on the walls so far, so that none hangs over another.
class WallSpace {
 public:
  WallSpace(const WorldPlan& plan, const Building& building) : plan_(plan), building_(building) {}

  /// Hangs an item of this size on the wall at `at` and returns its frame, which is as Sign's and `thickness` before
  /// the wall. Throws base::Error naming section `name` unless it fits on a wall and hangs over nothing else.
  geometry::Se3 hang(const std::string& name, const OnWallPlan& at, double width, double height, double thickness);

 private:
  struct Taken {
    std::string name;
    const WallFace* wall;
    double low_u, high_u, low_z, high_z;
  };
  const WallFace& wallAt(const std::string& name, const Eigen::Vector2d& point) const;

  const WorldPlan& plan_;
  const Building& building_;
  std::vector<Taken> taken_;
};

}  // namespace omnimapper::sim
