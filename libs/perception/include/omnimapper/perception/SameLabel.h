#pragma once

#include <cstdint>
#include <cstring>
#include <type_traits>

namespace omnimapper::perception {

/// Comparator for connectComponents(): joins neighbours with the same label, an integer that is not 0.
template <class Label>
struct SameLabel {
  const Label* labels;

  bool valid(int pixel) const { return labels[pixel] != 0; }
  bool similar(int a, int b) const { return labels[a] == labels[b]; }
};

template <class Label>
SameLabel(const Label*) -> SameLabel<Label>;

/// The first pixel from `begin` on whose label is not `label`, or `end`. Compares 64 bytes at a time, then eight bytes,
/// then single labels.
template <class Label>
int endOfLabel(const Label* labels, Label label, int begin, int end) {
  using Unsigned = std::make_unsigned_t<Label>;
  constexpr int kInWord = 8 / sizeof(Label);
  const std::uint64_t repeated = static_cast<Unsigned>(label) * (~0ULL / static_cast<Unsigned>(-1));
  std::uint64_t next[8];
  for (; begin + 8 * kInWord <= end; begin += 8 * kInWord) {
    std::memcpy(next, labels + begin, sizeof(next));
    std::uint64_t different = 0;
    for (const std::uint64_t n : next) different |= n ^ repeated;
    if (different != 0) break;
  }
  for (; begin + kInWord <= end; begin += kInWord) {
    std::memcpy(next, labels + begin, sizeof(next[0]));
    if (next[0] != repeated) break;
  }
  while (begin < end && labels[begin] == label) ++begin;
  return begin;
}

template <class Label>
int beginOfRun(const SameLabel<Label>& comparator, int begin, int end_of_row) {
  return endOfLabel(comparator.labels, Label(0), begin, end_of_row);
}

template <class Label>
int endOfRun(const SameLabel<Label>& comparator, int begin, int end_of_row) {
  return endOfLabel(comparator.labels, comparator.labels[begin], begin + 1, end_of_row);
}

template <class Label>
bool touch(const SameLabel<Label>& comparator, int above, int below, int) {
  return comparator.labels[above] == comparator.labels[below];
}

}  // namespace omnimapper::perception
