#pragma once

#include <omnimapper/sim_world/Random.h>

#include <array>
#include <vector>

namespace omnimapper::sim {

/// A nearly normal number, mean 0, standard deviation 1, never beyond 3.5: the sum of four uniform ones. For pixels,
/// of which there are many.
inline float quickGaussian(Random& random) {
  const std::uint64_t bits = random.bits();
  const auto sum = static_cast<float>((bits & 0xFFFF) + (bits >> 16 & 0xFFFF) + (bits >> 32 & 0xFFFF) + (bits >> 48));
  return (sum - 2 * 65535.0f) * (1.7320508f / 65536.0f);
}

/// Three coarser ones at once, each the sum of three, for the channels of a picture.
inline std::array<float, 3> quickGaussians(Random& random) {
  constexpr float kMean = 3 * 63.5f, kSigma = 63.998f;  // of three numbers from 0 to 127
  std::uint64_t bits = random.bits();
  std::array<float, 3> values;
  for (float& value : values) {
    value = (static_cast<float>((bits & 127) + (bits >> 7 & 127) + (bits >> 14 & 127)) - kMean) / kSigma;
    bits >>= 21;
  }
  return values;
}

/// Normal numbers of mean 0 and standard deviation 1 on a grid of pixels, row by row, that resemble their neighbours
/// up to about `reach` pixels away (averages of squares of that side, taken twice); reach <= 1: they do not.
std::vector<float> smoothNoise(int width, int height, int reach, Random& random);

}  // namespace omnimapper::sim
