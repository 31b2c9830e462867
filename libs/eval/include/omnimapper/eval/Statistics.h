#pragma once

#include <vector>

namespace omnimapper::eval {

/// Statistics of one kind of error, in the unit of the error. All are zero if there are no values.
struct Statistics {
  std::size_t count = 0;
  double mean = 0;
  double rmse = 0;    ///< root of the mean square
  double std = 0;     ///< root of the mean squared distance to the mean (divided by count, not count - 1)
  double median = 0;  ///< for an even count, the mean of the middle two values
  double max = 0;
};

Statistics statisticsOf(const std::vector<double>& values);

/// Share of the values that are in [0, threshold]; 0 if there are no values.
double shareWithin(const std::vector<double>& values, double threshold);

}  // namespace omnimapper::eval
