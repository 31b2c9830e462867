#pragma once

#include <optional>
#include <vector>

#include "Innovation.h"
#include "OutlierModel.h"
#include "omnimapper/graph/ChiSquare.h"
#include "omnimapper/graph/Consistency.h"

namespace omnimapper::graph {

/// The tests that a hypothesis must pass, by the options.
class Gate {
 public:
  explicit Gate(const ConsistencyOptions& options);
  /// Chi-square bound for a residual of `rows` rows.
  double bound(int rows) const;
  bool passes(const InnovationStatistics& innovation) const;
  /// The required likelihood ratio of a true to a false measurement, as a chi-square: twice its logarithm.
  double chi2OfRatio() const { return 2 * log_ratio_; }
  /// Logarithm of the likelihood ratio of a true to a false measurement, minus that of the required ratio; negative if
  /// a false one could be there by chance. `log_volume` is that of OutlierModel::logOf(); the result is 0 if it is
  /// none.
  double margin(const InnovationStatistics& innovation, std::optional<double> log_volume) const;

 private:
  double confidence_, log_ratio_;
  mutable std::vector<double> bounds_;  // by rows, 0 where not computed yet
};

/// The decision about one candidate.
struct Choice {
  enum class Kind { fits, agrees, waits, contradicts };
  Kind kind = Kind::contradicts;
  double chi2 = 0;
  std::optional<int> with;  ///< the candidate it agrees with or contradicts
};

/// Selects candidates that can all act, of those that do not act yet. `log_volumes` has one entry for each. Pairwise:
/// they are taken one after another, the most certain first; those that could be there by chance are taken only in
/// pairs in which each predicts the other sharply.
std::vector<Choice> selectPairwise(Innovation candidates, const std::vector<std::optional<double>>& log_volumes,
                                   const Gate& gate);
/// Graduated: truncated least squares over all candidates that fit by themselves, by graduated non-convexity; of its
/// inliers, those are taken that the other inliers predict sharply.
std::vector<Choice> selectGraduated(const Innovation& candidates, const std::vector<std::optional<double>>& log_volumes,
                                    const Gate& gate);

}  // namespace omnimapper::graph
