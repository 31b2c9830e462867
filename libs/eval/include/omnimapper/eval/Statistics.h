#pragma once

#include <vector>

namespace omnimapper::eval {

/// Statistics of one kind of error, in its unit. All zero if there are no values.
struct Statistics {
  std::size_t count = 0;
  double mean = 0;
  double rmse = 0;    ///< root of the mean square
  double std = 0;     ///< root of the mean squared distance to the mean (divided by count, not count - 1)
  double median = 0;  ///< mean of the middle two of an even count
  double max = 0;
};

Statistics statisticsOf(const std::vector<double>& values);

/// Share of values in [0, threshold]; 0 if there are none.
double shareWithin(const std::vector<double>& values, double threshold);

}  // namespace omnimapper::eval
