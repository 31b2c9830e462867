#include "Selection.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace omnimapper::graph {

Gate::Gate(const ConsistencyOptions& options)
    : confidence_(options.confidence), log_ratio_(std::log(options.min_likelihood_ratio)) {}

double Gate::bound(int rows) const {
  if (static_cast<int>(bounds_.size()) <= rows) bounds_.resize(rows + 1, 0);
  if (bounds_[rows] == 0) bounds_[rows] = chiSquareQuantile(confidence_, rows);
  return bounds_[rows];
}

bool Gate::passes(const InnovationStatistics& innovation) const {
  return innovation.chi2() <= bound(static_cast<int>(innovation.residual.size()));
}

double Gate::margin(const InnovationStatistics& innovation, std::optional<double> log_volume) const {
  return log_volume ? *log_volume + innovation.logDensity() - log_ratio_ : 0;
}

namespace {

/// Takes candidates out of `open_` one after another, and conditions the others on them.
class PairwiseSelection {
 public:
  PairwiseSelection(Innovation candidates, const std::vector<std::optional<double>>& log_volumes, const Gate& gate)
      : candidates_(std::move(candidates)), log_volumes_(log_volumes), gate_(gate), choices_(log_volumes.size()) {
    for (int i = 0; i < candidates_.size(); ++i) open_.push_back(i);
  }

  std::vector<Choice> run() {
    while (takeSurest() || takePair()) {
    }
    for (const int i : open_) {
      const InnovationStatistics innovation = candidates_.of(i);
      choices_[i] = {gate_.passes(innovation) ? Choice::Kind::waits : Choice::Kind::contradicts, innovation.chi2(),
                     std::nullopt};
    }
    return choices_;
  }

 private:
  void take(int i, Choice::Kind kind, std::optional<int> with) {
    choices_[i] = {kind, candidates_.of(i).chi2(), with};
    open_.erase(std::find(open_.begin(), open_.end(), i));
    candidates_.condition(i);
  }

  bool takeSurest() {
    int surest = -1;
    double best = 0;
    for (const int i : open_) {
      const InnovationStatistics innovation = candidates_.of(i);
      if (!gate_.passes(innovation)) continue;
      const double margin = gate_.margin(innovation, log_volumes_[i]);
      if (margin < best || (margin == best && surest >= 0)) continue;
      surest = i;
      best = margin;
    }
    if (surest >= 0) take(surest, Choice::Kind::fits, std::nullopt);
    return surest >= 0;
  }

  bool takePair() {
    int first = -1, second = -1;
    double best = 0;
    for (const int i : open_)
      for (const int j : open_) {
        if (j >= i || !gate_.passes(candidates_.of(i)) || !gate_.passes(candidates_.of(j))) continue;
        const InnovationStatistics of_i = candidates_.given(i, j), of_j = candidates_.given(j, i);
        if (!gate_.passes(of_i) || !gate_.passes(of_j)) continue;
        const double margin = std::min(gate_.margin(of_i, log_volumes_[i]), gate_.margin(of_j, log_volumes_[j]));
        if (margin <= best) continue;
        first = j;
        second = i;
        best = margin;
      }
    if (first < 0) return false;
    take(first, Choice::Kind::agrees, second);
    take(second, Choice::Kind::agrees, first);
    return true;
  }

  Innovation candidates_;
  const std::vector<std::optional<double>>& log_volumes_;
  const Gate& gate_;
  std::vector<Choice> choices_;
  std::vector<int> open_;
};

/// Weights of graduated non-convexity for truncated least squares, 0 or 1 at the end. The problem is linear: the
/// candidates' residuals are (I + K W)^-1 r, where K is their covariance without their own noise.
std::vector<double> graduatedWeights(const Innovation& candidates, const std::vector<int>& among, const Gate& gate) {
  constexpr double kGrowth = 1.4;
  constexpr int kMaxIterations = 60;
  const InnovationStatistics all = candidates.of(among);
  const Eigen::Index rows = all.residual.size();
  const Eigen::MatrixXd spread = all.covariance - Eigen::MatrixXd::Identity(rows, rows);
  std::vector<double> weights(among.size(), 1);
  double mu = 0;
  for (int iteration = 0; iteration < kMaxIterations; ++iteration) {
    Eigen::VectorXd by_row(rows);
    Eigen::Index row = 0;
    for (std::size_t k = 0; k < among.size(); ++k)
      for (int i = 0; i < candidates.degreesOfFreedom(among[k]); ++i) by_row[row++] = weights[k];
    const Eigen::MatrixXd system = Eigen::MatrixXd::Identity(rows, rows) + spread * by_row.asDiagonal();
    const Eigen::VectorXd left = system.partialPivLu().solve(all.residual);
    std::vector<double> misfits;  // relative to the bound
    row = 0;
    for (const int i : among) {
      const int size = candidates.degreesOfFreedom(i);
      misfits.push_back(left.segment(row, size).squaredNorm() / gate.bound(size));
      row += size;
    }
    const double worst = *std::max_element(misfits.begin(), misfits.end());
    if (iteration == 0) {
      if (worst <= 1) break;
      mu = 1 / (2 * worst - 1);
    }
    bool decided = true;
    for (std::size_t k = 0; k < among.size(); ++k) {
      if (misfits[k] >= (mu + 1) / mu)
        weights[k] = 0;
      else if (misfits[k] <= mu / (mu + 1))
        weights[k] = 1;
      else
        weights[k] = std::sqrt(mu * (mu + 1) / misfits[k]) - mu;
      decided = decided && (weights[k] == 0 || weights[k] == 1);
    }
    if (decided && mu > 1) break;
    mu *= kGrowth;
  }
  for (double& weight : weights) weight = weight > 0.5 ? 1 : 0;
  return weights;
}

}  // namespace

std::vector<Choice> selectPairwise(Innovation candidates, const std::vector<std::optional<double>>& log_volumes,
                                   const Gate& gate) {
  return PairwiseSelection(std::move(candidates), log_volumes, gate).run();
}

std::vector<Choice> selectGraduated(const Innovation& candidates, const std::vector<std::optional<double>>& log_volumes,
                                    const Gate& gate) {
  std::vector<Choice> choices(log_volumes.size());
  std::vector<int> fitting;
  for (int i = 0; i < candidates.size(); ++i) {
    choices[i].chi2 = candidates.of(i).chi2();
    if (gate.passes(candidates.of(i))) fitting.push_back(i);
  }
  if (fitting.empty()) return choices;
  const std::vector<double> weights = graduatedWeights(candidates, fitting, gate);
  std::vector<int> inliers;
  for (std::size_t k = 0; k < fitting.size(); ++k)
    if (weights[k] > 0) inliers.push_back(fitting[k]);
  while (!inliers.empty()) {
    std::size_t worst = 0;
    double least = 0;
    for (std::size_t k = 0; k < inliers.size(); ++k) {
      std::vector<int> others = inliers;
      others.erase(others.begin() + static_cast<std::ptrdiff_t>(k));
      const InnovationStatistics innovation = candidates.given(inliers[k], others);
      const double margin =
          gate.passes(innovation) ? gate.margin(innovation, log_volumes[inliers[k]]) : -innovation.chi2();
      if (margin >= least) continue;
      worst = k;
      least = margin;
    }
    if (least == 0) break;
    choices[inliers[worst]].kind = Choice::Kind::waits;
    inliers.erase(inliers.begin() + static_cast<std::ptrdiff_t>(worst));
  }
  for (const int i : inliers) choices[i].kind = inliers.size() > 1 ? Choice::Kind::agrees : Choice::Kind::fits;
  return choices;
}

}  // namespace omnimapper::graph
