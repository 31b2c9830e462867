#pragma once

#include <memory>
#include <vector>

#include "Frame.h"
#include "TexturePyramid.h"
#include "Wear.h"

namespace omnimapper::sim {

/// Colours of what a frame sees, by texture, material and the light of the world. Immutable, thread-safe.
///
/// The light is that of a building whose lamps hang on a grid below the ceilings: light from all around, more of it
/// from above, and three far lamps without shadows. All of it is brighter below the lamps of the grid than between
/// them.
class Shader {
 public:
  /// `scenes` must outlive it.
  Shader(const World& world, const Scenes& scenes);
  /// Linear RGB row by row; a white wall is about 0.7.
  std::vector<Eigen::Vector3f> shade(const Frame& frame) const;

 private:
  /// `along` is the vector from the eye to the pixel's point at depth 1, in the map. There the pixel is `pixel_side`
  /// wide [m]; it covers `footprint` texels.
  Eigen::Vector3f colourOf(const PixelHit& hit, const Eigen::Vector3f& along, const Eigen::Vector3f& eye,
                           float pixel_side, float footprint) const;
  float footprint(const Frame& frame, int column, int row, const TexturePyramid& texture) const;

  const Scenes& scenes_;
  std::vector<std::shared_ptr<const TexturePyramid>> textures_;  // by surface number; none: one colour
  Wear wear_;
};

}  // namespace omnimapper::sim
