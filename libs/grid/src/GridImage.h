#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace omnimapper::grid {

/// The image of a grid, rows from the top.
struct GridImage {
  int columns = 0, rows = 0;
  int white = 255;                   ///< level of white
  std::vector<std::uint8_t> levels;  ///< mean of all channels, with the opacity, as map_server does
  std::vector<std::uint8_t> opaque;  ///< whether a pixel is opaque; empty if all are
};

/// Reads a binary PGM of 8 bits or a PNG. Throws Error(unreadable_input), naming the file and the reason.
GridImage readGridImage(const std::string& file);

}  // namespace omnimapper::grid
