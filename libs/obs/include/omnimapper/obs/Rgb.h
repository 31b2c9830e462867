#pragma once

#include <cstdint>

namespace omnimapper::obs {

struct Rgb {
  std::uint8_t red = 0, green = 0, blue = 0;
};

inline bool operator==(const Rgb& a, const Rgb& b) {
  return a.red == b.red && a.green == b.green && a.blue == b.blue;
}

}  // namespace omnimapper::obs
