#pragma once

#include <omnimapper/sim_world/Random.h>

#include <array>
#include <vector>

namespace omnimapper::sim {

/// A nearly normal random number with mean 0 and standard deviation 1, never beyond 3.5: the sum of four uniform ones.
/// It is fast, for use in every pixel.
inline float quickGaussian(Random& random) {
  const std::uint64_t bits = random.bits();
  const auto sum = static_cast<float>((bits & 0xFFFF) + (bits >> 16 & 0xFFFF) + (bits >> 32 & 0xFFFF) + (bits >> 48));
  return (sum - 2 * 65535.0f) * (1.7320508f / 65536.0f);
}

/// Three coarser numbers at once, each the sum of three uniform ones, for the channels of a picture.
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

/// Normal numbers with mean 0 and standard deviation 1 on a grid of pixels, row by row. They are correlated up to about
/// `reach` pixels (averages over squares of that side, taken twice), and independent if reach <= 1.
std::vector<float> smoothNoise(int width, int height, int reach, Random& random);

}  // namespace omnimapper::sim
