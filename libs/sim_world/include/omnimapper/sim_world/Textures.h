#pragma once

#include <omnimapper/sim_world/Texture.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace omnimapper::sim {

enum class TextureKind {
  wood,       ///< grain along u: table tops, doors
  planks,     ///< a floor of four boards across v, grain along u
  carpet,     ///< fine flecks
  tiles,      ///< four by four, with joints
  bricks,     ///< in running bond, mortar between
  plaster,    ///< a wall with hardly any texture, as most walls are
  concrete,   ///< spots and hair cracks
  asphalt,    ///< dark, with bright grains
  cloth,      ///< woven, two colours
  wallpaper,  ///< stripes with a small figure
  noise,      ///< strong on all scales, so that every patch of it is unique
  checker,    ///< eight by eight fields, black and white
  books,      ///< one row of spines, standing
  print       ///< coloured shapes, as on a package
};

/// Every kind's name, in order: "wood", "planks", ...
const std::vector<std::string>& textureKindNames();
/// Throws base::Error(out_of_range) that lists the known names.
TextureKind textureKindOf(const std::string& name);

/// Side of the square in the world that one picture of this kind covers [m].
double textureSide(TextureKind kind);

/// A picture that repeats without a seam, `side` pixels square. The same kind, seed and side give the same bytes;
/// colours, widths and all else that varies come from the seed. Throws std::invalid_argument unless 16 <= side <= 1024.
std::shared_ptr<const Texture> makeTexture(TextureKind kind, std::uint64_t seed, int side = 256);

}  // namespace omnimapper::sim
