#pragma once

#include <cstdint>
#include <cstring>

#if defined(__x86_64__)
#include <emmintrin.h>
#endif

#include "../planes/Lanes.h"

namespace omnimapper::perception::edges {

using Shorts = std::int16_t __attribute__((vector_size(32)));

constexpr int kShorts = 16;

// Compilers make long sequences of what SSE2, which every x86-64 has, does in one step.

/// Stores eight lanes, from 0 to 255, as bytes.
OMNIMAPPER_KERNEL_BODY void storeMarks(const planes::LaneMask& marks, std::uint8_t* to) {
#if defined(__x86_64__)
  __m128i halves[2];
  std::memcpy(halves, &marks, sizeof(halves));
  const __m128i shorts = _mm_packs_epi32(halves[0], halves[1]);
  _mm_storel_epi64(reinterpret_cast<__m128i*>(to), _mm_packus_epi16(shorts, shorts));
#else
  for (int k = 0; k < planes::kLanes; ++k) to[k] = static_cast<std::uint8_t>(marks[k]);
#endif
}

/// Stores sixteen lanes, from 0 to 255, as bytes.
OMNIMAPPER_KERNEL_BODY void storeMarks(const Shorts& marks, std::uint8_t* to) {
#if defined(__x86_64__)
  __m128i halves[2];
  std::memcpy(halves, &marks, sizeof(halves));
  _mm_storeu_si128(reinterpret_cast<__m128i*>(to), _mm_packus_epi16(halves[0], halves[1]));
#else
  for (int k = 0; k < kShorts; ++k) to[k] = static_cast<std::uint8_t>(marks[k]);
#endif
}

/// Lanes that are not negative, times `factor` / 2^16, rounded down.
OMNIMAPPER_KERNEL_BODY void scaleDown(const Shorts& lanes, std::uint16_t factor, Shorts& scaled) {
#if defined(__x86_64__)
  __m128i halves[2];
  std::memcpy(halves, &lanes, sizeof(halves));
  const __m128i factors = _mm_set1_epi16(static_cast<std::int16_t>(factor));
  for (__m128i& half : halves) half = _mm_mulhi_epu16(half, factors);
  std::memcpy(&scaled, halves, sizeof(scaled));
#else
  for (int k = 0; k < kShorts; ++k) scaled[k] = static_cast<std::int16_t>(lanes[k] * factor >> 16);
#endif
}

/// Calls visit(x) for each mark of a row that is not 0, from the left. `marks` has a multiple of eight bytes.
template <class Visit>
void forEachMark(const std::uint8_t* marks, int n, const Visit& visit) {
  for (int x = 0; x < n; x += 8) {
    std::uint64_t word;
    std::memcpy(&word, marks + x, sizeof(word));
    for (int k = x; word != 0; word >>= 8, ++k) {
      if ((word & 0xFF) != 0) visit(k);
    }
  }
}

}  // namespace omnimapper::perception::edges
