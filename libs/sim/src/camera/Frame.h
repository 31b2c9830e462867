#pragma once

#include <omnimapper/sim/Pinhole.h>
#include <omnimapper/sim_world/Scene.h>

#include <cstdint>
#include <vector>

namespace omnimapper::sim {

/// The first surface on the ray through the centre of a pixel.
struct PixelHit {
  double depth = 0;  ///< along the optical axis, exact; 0: nothing is there [m]
  int surface = -1;  ///< number as numberSurfaces() counts; -1: nothing
  float cosine = 0;  ///< of the angle between the ray and the surface's normal
  Eigen::Vector3f normal_in_map = Eigen::Vector3f::Zero();
  Eigen::Vector2f texture_at = Eigen::Vector2f::Zero();
};

/// What a pixel shows through glass.
struct HitThroughGlass {
  int pixel = 0;           ///< its number, row by row
  float transmission = 1;  ///< part of the light that passes the panes in one direction
  PixelHit hit;            ///< the first surface that is not glass; depth 0: none
};

/// A pinhole image of hits: exact geometry, without a sensor model.
struct Frame {
  Pinhole camera;
  geometry::Se3 map_from_optical;
  std::vector<PixelHit> pixels;  ///< row by row
  std::vector<HitThroughGlass> seen_through;

  const PixelHit& at(int column, int row) const {
    return pixels[static_cast<std::size_t>(row) * camera.width + column];
  }
};

/// Casts one ray for each pixel, and further ones through glass.
Frame castFrame(const Scenes& scenes, const Scene& scene, const Pinhole& camera, const geometry::Se3& map_from_optical);

/// The first hit on a ray that is not glass, with the part of the light that gets there.
std::pair<Hit, float> castThroughGlass(const Scenes& scenes, const Scene& scene, Ray ray);

/// For each pixel with a depth: whether something stands between its point and another one beside the camera.
std::vector<char> findShadow(const Frame& frame, const Scene& scene, const Eigen::Vector3d& other_in_optical);

/// Surface numbers plus one, row by row; 0: nothing. Throws base::Error(out_of_range) above 65535 surfaces.
std::vector<std::uint16_t> labelsOf(const Frame& frame);

/// Depths row by row, 0: nothing [m].
std::vector<float> exactDepth(const Frame& frame);

/// Depths in units of `unit` [m], rounded; 0: nothing, or too far for 16 bits.
std::vector<std::uint16_t> depthsOf(const Frame& frame, double unit);

}  // namespace omnimapper::sim
