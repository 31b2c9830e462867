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
  std::vector<int> pixels;     ///< number of pixels of each component; components are sorted by their first pixel

  /// For each pixel the number of its component plus 1, or 0 for pixels of no component and of components with fewer
  /// than `fewest` pixels.
  std::vector<std::int32_t> labels(int fewest = 1) const;
};

namespace detail {

constexpr int kNoSet = -1;

/// Disjoint sets of numbers, which can be united. The least number of a set represents it.
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

  int size() const { return static_cast<int>(parent_.size()); }

 private:
  int& parent(int i) { return parent_[static_cast<std::size_t>(i)]; }
  std::vector<int> parent_;
};

/// Second pass of connectComponents(): replaces the provisional numbers of the runs by the numbers of their components.
void numberComponents(UnionFind& sets, Components& components);

}  // namespace detail

/// connectComponents() calls the following three functions for each row. A comparator that can decide about many pixels
/// at once, such as SameLabel, has its own overloads of these functions.

/// The first valid pixel from `begin` on, or `end_of_row`.
template <class Comparator>
int beginOfRun(const Comparator& comparator, int begin, int end_of_row) {
  while (begin < end_of_row && !comparator.valid(begin)) ++begin;
  return begin;
}

/// One past the last pixel of the run that begins with the valid pixel `begin`.
template <class Comparator>
int endOfRun(const Comparator& comparator, int begin, int end_of_row) {
  int end = begin + 1;
  while (end < end_of_row && comparator.valid(end) && comparator.similar(end - 1, end)) ++end;
  return end;
}

/// Whether any of the `n` pixels from `below` on is similar to the pixel above it; the first of the upper pixels is
/// `above`. The upper pixels belong to one run, and so do the lower ones.
template <class Comparator>
bool touch(const Comparator& comparator, int above, int below, int n) {
  for (int i = 0; i < n; ++i) {
    if (comparator.similar(above + i, below + i)) return true;
  }
  return false;
}

/// Finds the 4-connected components of an image in two passes with union-find (thesis 3.4.2). The comparator decides
/// which pixels belong together; pixels are numbered row by row:
///   bool valid(int pixel) const;           whether the pixel may belong to a component
///   bool similar(int a, int b) const;      for valid neighbours a and b, where b is to the right of a or below a
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
    const int end_of_row = first + width;
    int pixel = first;
    while ((pixel = beginOfRun(comparator, pixel, end_of_row)) < end_of_row) {
      const int end = endOfRun(comparator, pixel, end_of_row);
      PixelRun run{row, pixel - first, end - first, detail::kNoSet};
      while (upper < here && result.runs[upper].end <= run.begin) ++upper;
      for (std::size_t i = upper; i < here && result.runs[i].begin < run.end; ++i) {
        const PixelRun& over = result.runs[i];
        if (over.component == run.component) continue;
        const int from = over.begin > run.begin ? over.begin : run.begin;
        const int to = over.end < run.end ? over.end : run.end;
        if (!touch(comparator, first - width + from, first + from, to - from)) continue;
        if (run.component == detail::kNoSet) {
          run.component = over.component;
        } else {
          sets.unite(over.component, run.component);
        }
      }
      if (run.component == detail::kNoSet) run.component = sets.add();
      result.runs.push_back(run);
      pixel = end;
    }
    above = here;
  }
  detail::numberComponents(sets, result);
  return result;
}

}  // namespace omnimapper::perception
