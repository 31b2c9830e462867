#pragma once

#include <cstdint>
#include <vector>

namespace omnimapper::perception {

/// Pixels [begin, end) of a row that belong to one component.
struct PixelRun {
  int row = 0, begin = 0, end = 0;
  int component = 0;
};

struct Components {
  int width = 0, height = 0;
  std::vector<PixelRun> runs;  ///< from top to bottom, from left to right
  std::vector<int> pixels;     ///< of each component; components are numbered by their first pixel

  /// For each pixel its component + 1, or 0 where it belongs to none or to one with fewer than `fewest` pixels.
  std::vector<std::int32_t> labels(int fewest = 1) const;
};

namespace detail {

/// Sets of numbers that grow together. The least number stands for its set.
class UnionFind {
 public:
  int add() {
    parent_.push_back(static_cast<int>(parent_.size()));
    return parent_.back();
  }
  int find(int i) {
    while (parent(i) != i) i = parent(i) = parent(parent(i));
    return i;
  }
  void unite(int i, int j) {
    i = find(i);
    j = find(j);
    (i < j ? parent(j) : parent(i)) = i < j ? i : j;
  }

 private:
  int& parent(int i) { return parent_[static_cast<std::size_t>(i)]; }
  std::vector<int> parent_;
};

/// Second pass: provisional numbers become those of components.
void numberComponents(UnionFind& sets, Components& components);

}  // namespace detail

/// One past the last pixel of the run that begins with the valid pixel `begin`. A comparator that can jump ahead, such
/// as one of equal labels, brings an overload of its own.
template <class Comparator>
int endOfRun(const Comparator& comparator, int begin, int end_of_row) {
  int end = begin + 1;
  while (end < end_of_row && comparator.valid(end) && comparator.similar(end - 1, end)) ++end;
  return end;
}

/// Connected components of an image in two passes with union-find, 4-connected (thesis 3.4.2). What belongs together is
/// the comparator's to say; pixels are numbered row by row:
///   bool valid(int pixel) const;           whether it may belong to a component
///   bool similar(int a, int b) const;      for valid neighbours, b right of a or below it
template <class Comparator>
Components connectComponents(int width, int height, const Comparator& comparator) {
  Components result;
  result.width = width;
  result.height = height;
  detail::UnionFind sets;
  std::size_t above = 0;  // first run of the row above
  for (int row = 0, first = 0; row < height; ++row, first += width) {
    const std::size_t here = result.runs.size();
    std::size_t upper = above;
    for (int pixel = first; pixel < first + width;) {
      if (!comparator.valid(pixel)) {
        ++pixel;
        continue;
      }
      const int end = endOfRun(comparator, pixel, first + width);
      const PixelRun run{row, pixel - first, end - first, sets.add()};
      while (upper < here && result.runs[upper].end <= run.begin) ++upper;
      for (std::size_t i = upper; i < here && result.runs[i].begin < run.end; ++i) {
        const PixelRun& over = result.runs[i];
        if (sets.find(over.component) == sets.find(run.component)) continue;
        const int last = first + (over.end < run.end ? over.end : run.end);
        int x = first + (over.begin > run.begin ? over.begin : run.begin);
        while (x < last && !comparator.similar(x - width, x)) ++x;
        if (x < last) sets.unite(over.component, run.component);
      }
      result.runs.push_back(run);
      pixel = end;
    }
    above = here;
  }
  detail::numberComponents(sets, result);
  return result;
}

}  // namespace omnimapper::perception
