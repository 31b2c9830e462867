#include <omnimapper/eval/Statistics.h>

#include <algorithm>
#include <cmath>

namespace omnimapper::eval {

Statistics statisticsOf(const std::vector<double>& values) {
  Statistics result;
  result.count = values.size();
  if (values.empty()) return result;
  const auto count = static_cast<double>(values.size());
  double sum = 0, sum_of_squares = 0;
  for (const double value : values) {
    sum += value;
    sum_of_squares += value * value;
  }
  result.mean = sum / count;
  result.rmse = std::sqrt(sum_of_squares / count);
  double spread = 0;
  for (const double value : values) spread += (value - result.mean) * (value - result.mean);
  result.std = std::sqrt(spread / count);

  std::vector<double> sorted = values;
  std::sort(sorted.begin(), sorted.end());
  const std::size_t half = sorted.size() / 2;
  result.median = sorted.size() % 2 == 1 ? sorted[half] : 0.5 * (sorted[half - 1] + sorted[half]);
  result.max = sorted.back();
  return result;
}

double shareWithin(const std::vector<double>& values, double threshold) {
  if (values.empty()) return 0;
  const auto within = std::count_if(values.begin(), values.end(), [&](double value) { return value <= threshold; });
  return static_cast<double>(within) / static_cast<double>(values.size());
}

}  // namespace omnimapper::eval
