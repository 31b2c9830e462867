#pragma once

#include <cstdint>
#include <cstring>

namespace omnimapper::perception::planes {

/// Comparator for connectComponents(): pixels with the same label, which is not 0.
struct SameLabel {
  const std::uint16_t* labels;

  bool valid(int pixel) const { return labels[pixel] != 0; }
  bool similar(int a, int b) const { return labels[a] == labels[b]; }
};

/// The first pixel from `begin` on with another label than `label`, or `end`: many at a time, then four, then one.
inline int endOfLabel(const std::uint16_t* labels, std::uint16_t label, int begin, int end) {
  const std::uint64_t four = label * 0x0001000100010001ULL;
  std::uint64_t next[8];
  for (; begin + 32 <= end; begin += 32) {
    std::memcpy(next, labels + begin, sizeof(next));
    std::uint64_t different = 0;
    for (const std::uint64_t n : next) different |= n ^ four;
    if (different != 0) break;
  }
  for (; begin + 4 <= end; begin += 4) {
    std::memcpy(next, labels + begin, sizeof(next[0]));
    if (next[0] != four) break;
  }
  while (begin < end && labels[begin] == label) ++begin;
  return begin;
}

inline int beginOfRun(const SameLabel& comparator, int begin, int end_of_row) {
  return endOfLabel(comparator.labels, 0, begin, end_of_row);
}

inline int endOfRun(const SameLabel& comparator, int begin, int end_of_row) {
  return endOfLabel(comparator.labels, comparator.labels[begin], begin + 1, end_of_row);
}

inline bool touch(const SameLabel& comparator, int above, int below, int) {
  return comparator.labels[above] == comparator.labels[below];
}

}  // namespace omnimapper::perception::planes
