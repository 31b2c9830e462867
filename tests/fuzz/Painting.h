#pragma once

#include <cstdint>
#include <vector>

#include "Input.h"

namespace omnimapper::fuzz {

/// Size of an image: mostly small, sometimes long and narrow, or larger than allowed.
struct Size {
  int width, height;
};

inline Size takeSize(Input& input) {
  switch (input.take<std::uint8_t>() % 16) {
    case 0:
      return {input.below(6000), input.below(3)};
    case 1:
      return {input.below(3), input.below(6000)};
    case 2:
      return {input.take<std::int32_t>(), input.take<std::int32_t>()};
    case 3:
      return {65536 + input.below(256), 1 + input.below(4)};
    default:
      return {input.below(96), input.below(64)};
  }
}

/// Depths [m], row by row, of rectangles that are painted over each other until the input ends: planes, noise, odd
/// values, or values from the input for each pixel.
inline std::vector<float> paintDepths(Input& input, const Size& size) {
  constexpr float kOdd[] = {std::numeric_limits<float>::quiet_NaN(),
                            0,
                            std::numeric_limits<float>::infinity(),
                            -1,
                            -std::numeric_limits<float>::infinity(),
                            1e-30F,
                            1e-42F,
                            1e30F,
                            65.535F,
                            0.2F,
                            12};
  const auto width = static_cast<std::size_t>(size.width);
  std::vector<float> depths(width * static_cast<std::size_t>(size.height), 2.F);
  for (int strokes = 0; !input.atEnd() && !depths.empty() && strokes < 12; ++strokes) {
    const int kind = input.take<std::uint8_t>();
    const int left = input.take<std::uint8_t>() % size.width, top = input.take<std::uint8_t>() % size.height;
    const int right = left + 1 + input.below(size.width - left), bottom = top + 1 + input.below(size.height - top);
    const double a = input.between(-0.02, 0.02), b = input.between(-0.02, 0.02), c = input.oddBetween(0.05, 3);
    std::uint32_t random = static_cast<std::uint32_t>(kind) * 2654435761U + 1;
    for (int y = top; y < bottom; ++y) {
      for (int x = left; x < right; ++x) {
        float& depth = depths[static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x)];
        random = random * 1664525U + 1013904223U;
        const double inverse = a * (x - left) + b * (y - top) + c;
        if (kind < 96) {
          depth = static_cast<float>(1 / inverse);
        } else if (kind < 160) {
          depth = static_cast<float>(1 / (inverse + (random >> 24) * 1e-4));
        } else if (kind < 176) {
          depth = static_cast<float>((random >> 16) * 1e-3);
        } else if (kind < 208) {
          depth = kOdd[static_cast<std::size_t>(kind) % std::size(kOdd)];
        } else if (kind < 224) {
          if ((random >> 28) < 5) depth = kOdd[static_cast<std::size_t>(kind) % std::size(kOdd)];
        } else {
          depth = kind % 2 == 0 ? static_cast<float>(input.take<std::uint8_t>()) * 0.05F : input.take<float>();
        }
      }
    }
  }
  return depths;
}

/// The depths in whole units of `unit` [m]. Values that do not fit are saturated or wrapped, as by a careless driver.
inline std::vector<std::uint16_t> inUnits(const std::vector<float>& depths, double unit, bool wrapped) {
  std::vector<std::uint16_t> units;
  units.reserve(depths.size());
  for (const float depth : depths) {
    const double count = static_cast<double>(depth) / unit;
    const bool fits = count >= 0 && count < (wrapped ? 1e9 : 65535);
    units.push_back(fits ? static_cast<std::uint16_t>(static_cast<std::uint32_t>(count))
                         : static_cast<std::uint16_t>(count > 0 ? 65535 : 0));
  }
  return units;
}

}  // namespace omnimapper::fuzz
