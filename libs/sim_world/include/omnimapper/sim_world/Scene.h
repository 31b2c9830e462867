#pragma once

#include <omnimapper/sim_world/World.h>

#include <limits>
#include <memory>
#include <vector>

namespace omnimapper::sim {

struct Ray {
  Eigen::Vector3d origin_in_map;     ///< [m]
  Eigen::Vector3d direction_in_map;  ///< unit
  double near = 0;                   ///< hits nearer than this do not count [m]
  double far = 1e4;                  ///< hits farther than this do not count [m]
};

struct Hit {
  double range = std::numeric_limits<double>::infinity();   ///< along the ray, exact on the triangle's plane [m]
  int surface = -1;                                         ///< number as numberSurfaces() counts; -1: nothing hit
  Eigen::Vector3d normal_in_map = Eigen::Vector3d::Zero();  ///< unit, towards the ray's origin
  Eigen::Vector2f texture_at = Eigen::Vector2f::Zero();
  bool isHit() const { return surface >= 0; }
};

/// The world at one time, for ray casting. Immutable; any number of threads may use it at once.
class Scene {
 public:
  class Part;
  explicit Scene(std::vector<std::shared_ptr<const Part>> parts) : parts_(std::move(parts)) {}

  /// The nearest hit of each ray. Neighbouring rays are faster in one call than in separate ones.
  void cast(const std::vector<Ray>& rays, std::vector<Hit>& hits) const;
  /// As above, for arrays of `count` elements.
  void cast(const Ray* rays, std::size_t count, Hit* hits) const;
  Hit cast(const Ray& ray) const;
  /// Sets blocked[i] to 1 if something lies on ray i between near and far, and to 0 otherwise. Glass blocks, too.
  void findBlocked(const std::vector<Ray>& rays, std::vector<char>& blocked) const;
  /// As above, for arrays of `count` elements.
  void findBlocked(const Ray* rays, std::size_t count, char* blocked) const;

 private:
  std::vector<std::shared_ptr<const Part>> parts_;
};

/// Scenes of a world over time. Bodies that stand still between two times are built once. Thread-safe.
class Scenes {
 public:
  /// `world` must outlive this object.
  explicit Scenes(const World& world);
  ~Scenes();
  Scene at(double time) const;
  /// Material of a surface by its number.
  const Material& material(int surface) const { return *materials_[surface]; }

 private:
  struct Cache;
  const World& world_;
  std::vector<int> first_surface_;  // of each body
  std::vector<const Material*> materials_;
  std::unique_ptr<Cache> cache_;
};

}  // namespace omnimapper::sim
