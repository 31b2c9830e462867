#pragma once

#include <time.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace omnimapper::bench {

/// Processor time that this thread has used [ms].
inline double processorTime() {
  timespec t;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return 1e3 * static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_nsec);
}

/// Quantile q of the values; 0 if there are none.
inline double quantile(std::vector<double> values, double q) {
  if (values.empty()) return 0;
  const auto place = values.begin() + static_cast<std::ptrdiff_t>(q * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

struct Spread {
  double mean = 0, deviation = 0;
};

/// Mean and standard deviation; 0 if there are no values. The standard deviation of one value is 0.
inline Spread spreadOf(const std::vector<double>& values) {
  Spread spread;
  const auto count = static_cast<double>(std::max<std::size_t>(1, values.size()));
  for (const double value : values) spread.mean += value / count;
  double squares = 0;
  for (const double value : values) squares += (value - spread.mean) * (value - spread.mean);
  spread.deviation = std::sqrt(squares / std::max(1.0, count - 1));
  return spread;
}

}  // namespace omnimapper::bench
