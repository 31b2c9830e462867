#pragma once

#include <omnimapper/sim_world/Scene.h>

#include <memory>

namespace omnimapper::sim {

/// The ground under the wheels: surfaces of kind floor, road and kerb of all bodies but those in motion.
class Ground {
 public:
  explicit Ground(const World& world);
  ~Ground();
  /// Height of the highest such surface at (x, y) [m]; where there is none, that of the room's floor or, outside of
  /// rooms, of the nearest room's.
  double heightAt(const Eigen::Vector2d& point) const;

 private:
  const World& world_;
  World ground_;
  std::unique_ptr<Scenes> scenes_;
  double above_ = 0;  // [m] a height above all of the ground
};

}  // namespace omnimapper::sim
