#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace omnimapper::check {

/// The value that `part` of all lie below; `values` is not empty.
template <class Value>
Value quantile(std::vector<Value> values, double part) {
  const auto rank = static_cast<std::ptrdiff_t>(std::floor(part * static_cast<double>(values.size() - 1)));
  std::nth_element(values.begin(), values.begin() + rank, values.end());
  return values[static_cast<std::size_t>(rank)];
}

}  // namespace omnimapper::check
