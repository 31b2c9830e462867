#pragma once

#include <numeric>
#include <vector>

namespace omnimapper::building {

/// Sets of numbers from 0 on that can be joined (Galler and Fischer 1964).
class DisjointSets {
 public:
  DisjointSets() = default;
  explicit DisjointSets(int count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0); }

  /// Adds a set with the next number alone and returns this number.
  int add() {
    parent_.push_back(static_cast<int>(parent_.size()));
    return parent_.back();
  }
  /// The number that represents the set.
  int find(int i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  /// Joins the set of `other` to that of `kept`, whose representative stays.
  void join(int kept, int other) { parent_[find(other)] = find(kept); }

 private:
  std::vector<int> parent_;
};

}  // namespace omnimapper::building
