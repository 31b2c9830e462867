#pragma once

#include <optional>
#include <vector>

#include "Innovation.h"
#include "OutlierModel.h"
#include "omnimapper/graph/ChiSquare.h"
#include "omnimapper/graph/Consistency.h"

namespace omnimapper::graph {

/// What a hypothesis must pass, by the options.
class Gate {
 public:
  explicit Gate(const ConsistencyOptions& options);
  /// Chi-square bound for so many rows.
  double bound(int rows) const;
  bool passes(const InnovationStatistics& innovation) const;
  /// How many times likelier a measurement must be if true than if false, as chi-square: twice the logarithm.
  double chi2OfRatio() const { return 2 * log_ratio_; }
  /// Logarithm of how many times likelier the measurement is if true than if false, over what is asked; negative where
  /// a false one could be there by chance. `log_volume` as OutlierModel gives it.
  double margin(const InnovationStatistics& innovation, std::optional<double> log_volume) const;

 private:
  double confidence_, log_ratio_;
  mutable std::vector<double> bounds_;  // by rows, 0 where not computed yet
};

/// What is said of one candidate.
struct Choice {
  enum class Kind { fits, agrees, waits, contradicts };
  Kind kind = Kind::contradicts;
  double chi2 = 0;
  std::optional<int> with;  ///< the candidate it agrees with or contradicts
};

/// Of candidates that do not act yet, those that can all act. `log_volumes` is of each.
/// Pairwise: one after another, the surest first; those that could be there by chance only in pairs of which each
/// predicts the other sharply.
std::vector<Choice> selectPairwise(Innovation candidates, const std::vector<std::optional<double>>& log_volumes,
                                   const Gate& gate);
/// Graduated: truncated least squares over all that fit alone, by graduated non-convexity; of its inliers those that
/// the other inliers predict sharply.
std::vector<Choice> selectGraduated(const Innovation& candidates, const std::vector<std::optional<double>>& log_volumes,
                                    const Gate& gate);

}  // namespace omnimapper::graph
