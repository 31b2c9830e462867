#pragma once

#include <omnimapper/sim_world/Texture.h>

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace omnimapper::sim {

/// A texture for cameras: its sRGB values are made linear and averaged over squares of 1, 2, 4, ... texels, so that a
/// texture seen from afar does not flicker.
class TexturePyramid {
 public:
  explicit TexturePyramid(const Texture& texture);
  /// Linear colour in [0, 1]^3 at (u, v) as Texture::at(), averaged over about `footprint` texels.
  Eigen::Vector3f at(const Eigen::Vector2f& uv, float footprint) const;
  int width() const { return levels_.front().width; }
  int height() const { return levels_.front().height; }

 private:
  struct Level {
    int width, height;
    std::vector<std::uint16_t> rgb;
    Eigen::Vector3f at(float u, float v) const;
  };
  static Level halved(const Level& level);
  std::vector<Level> levels_;
};

}  // namespace omnimapper::sim
