#pragma once

#include <cstdint>
#include <cstring>

// A kernel is written once, as a body on eight lanes, and compiled twice: for baseline x86-64, where eight lanes are
// two SSE registers, and for AVX2. Each lane does the same IEEE operations in the same order in both, and no product is
// fused with a sum, so both give the same bits.
#define OMNIMAPPER_KERNEL_BODY static inline __attribute__((always_inline))
#if defined(__x86_64__)
#define OMNIMAPPER_KERNEL_AVX2 __attribute__((target("avx2")))
#endif

namespace omnimapper::perception::planes {

typedef float Lanes __attribute__((vector_size(32)));
typedef std::int32_t LaneMask __attribute__((vector_size(32)));

constexpr int kLanes = 8;
constexpr float kLaneColumns[kLanes] = {0, 1, 2, 3, 4, 5, 6, 7};

OMNIMAPPER_KERNEL_BODY void load(Lanes& lanes, const float* from) {
  std::memcpy(&lanes, from, sizeof(lanes));
}

OMNIMAPPER_KERNEL_BODY void store(const Lanes& lanes, float* to) {
  std::memcpy(to, &lanes, sizeof(lanes));
}

/// Whether the AVX2 kernels are used: the CPU has AVX2, and the environment variable OMNIMAPPER_AVX2 is not 0.
bool hasAvx2();

}  // namespace omnimapper::perception::planes
