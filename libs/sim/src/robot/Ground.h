#pragma once

#include <omnimapper/sim_world/Scene.h>

#include <memory>

namespace omnimapper::sim {

/// What wheels stand on: surfaces of kind floor, road and kerb of bodies that stand still.
class Ground {
 public:
  explicit Ground(const World& world);
  ~Ground();
  /// Height [m]: of the highest such surface below (x, y); where there is none, the floor of the room or of the
  /// nearest.
  double heightAt(const Eigen::Vector2d& point) const;

 private:
  const World& world_;
  World ground_;
  std::unique_ptr<Scenes> scenes_;
  double above_ = 0;  // [m] higher than all of it
};

}  // namespace omnimapper::sim
