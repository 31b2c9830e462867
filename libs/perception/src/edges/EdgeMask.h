#pragma once

#include <cstdint>
#include <cstring>

#if defined(__x86_64__)
#include <emmintrin.h>
#endif

#include "../planes/Lanes.h"

namespace omnimapper::perception::edges {

// SSE2, which every x86-64 has, is used directly: compilers generate long instruction sequences for these conversions.

/// Stores eight lanes, each from 0 to 255, as bytes.
OMNIMAPPER_KERNEL_BODY void storeMasks(const planes::LaneMask& masks, std::uint8_t* to) {
#if defined(__x86_64__)
  __m128i halves[2];
  std::memcpy(halves, &masks, sizeof(halves));
  const __m128i shorts = _mm_packs_epi32(halves[0], halves[1]);
  _mm_storel_epi64(reinterpret_cast<__m128i*>(to), _mm_packus_epi16(shorts, shorts));
#else
  for (int k = 0; k < planes::kLanes; ++k) to[k] = static_cast<std::uint8_t>(masks[k]);
#endif
}

/// Calls visit(x), from the left, for each pixel of a row whose mask is not 0. `masks` has a multiple of eight bytes.
template <class Visit>
void forEachMask(const std::uint8_t* masks, int n, const Visit& visit) {
  for (int x = 0; x < n; x += 8) {
    std::uint64_t word;
    std::memcpy(&word, masks + x, sizeof(word));
    for (int k = x; word != 0; word >>= 8, ++k) {
      if ((word & 0xFF) != 0) visit(k);
    }
  }
}

}  // namespace omnimapper::perception::edges
