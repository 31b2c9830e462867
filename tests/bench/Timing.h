#pragma once

#include <time.h>

#include <algorithm>
#include <vector>

namespace omnimapper::bench {

/// Time of the processor that this thread has used [ms].
inline double processorTime() {
  timespec t;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return 1e3 * static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_nsec);
}

/// 0 of no values.
inline double quantile(std::vector<double> values, double q) {
  if (values.empty()) return 0;
  const auto place = values.begin() + static_cast<std::ptrdiff_t>(q * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

}  // namespace omnimapper::bench
