#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace omnimapper::source {

/// The points of a PCD file (version 0.7 of PCL's format): coordinates, colours and labels. An organized cloud has its
/// points row by row from the top, as the camera saw them; any other cloud has one row.
struct PcdCloud {
  int width = 0, height = 0;
  std::vector<float> x, y, z;         ///< [m]; not a number where there is no point
  std::vector<std::uint32_t> rgb;     ///< 0xRRGGBB, one for each point or none at all
  std::vector<std::uint32_t> labels;  ///< one for each point or none at all
};

/// Reads a text, binary or compressed file. Throws Error(unreadable_input) if it is no PCD file, lacks x, y or z, has
/// more than 2^24 points, or ends too early.
PcdCloud readPcd(const std::string& path);

}  // namespace omnimapper::source
