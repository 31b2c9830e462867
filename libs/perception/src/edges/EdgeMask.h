#pragma once

#include <cstdint>
#include <cstring>

#if defined(__x86_64__)
#include <emmintrin.h>
#endif

#include "../planes/Lanes.h"

namespace omnimapper::perception::edges {

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
