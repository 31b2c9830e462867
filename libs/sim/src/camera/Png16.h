#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace omnimapper::sim {

/// A grey picture of 16 bits a pixel as the bytes of a PNG file (ISO/IEC 15948), values row by row from the top left.
/// Throws std::invalid_argument unless there are width * height of them.
std::string png16(const std::vector<std::uint16_t>& values, int width, int height);

}  // namespace omnimapper::sim
