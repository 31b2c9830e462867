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

/// Zeros and equal labels are skipped four pixels at a time.
inline int beginOfRun(const SameLabel& comparator, int begin, int end_of_row) {
  for (; begin + 4 <= end_of_row; begin += 4) {
    std::uint64_t next;
    std::memcpy(&next, comparator.labels + begin, sizeof(next));
    if (next != 0) break;
  }
  while (begin < end_of_row && comparator.labels[begin] == 0) ++begin;
  return begin;
}

inline int endOfRun(const SameLabel& comparator, int begin, int end_of_row) {
  const std::uint64_t four = comparator.labels[begin] * 0x0001000100010001ULL;
  int end = begin + 1;
  for (; end + 4 <= end_of_row; end += 4) {
    std::uint64_t next;
    std::memcpy(&next, comparator.labels + end, sizeof(next));
    if (next != four) break;
  }
  while (end < end_of_row && comparator.labels[end] == comparator.labels[begin]) ++end;
  return end;
}

inline bool touch(const SameLabel& comparator, int above, int below, int) {
  return comparator.labels[above] == comparator.labels[below];
}

}  // namespace omnimapper::perception::planes
