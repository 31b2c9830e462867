#include "JointCompatibility.h"

#include <omnimapper/graph/ChiSquare.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

namespace omnimapper::mapper {

namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

/// The pairings of a branch of the search, with the Cholesky factor of their joint covariance.
class Branch {
 public:
  explicit Branch(const JointInnovation& innovation) : innovation_(innovation) {
    // A branch has at most one pairing for each measurement.
    std::map<std::size_t, Eigen::Index> largest;
    for (const PairingRows& pairing : innovation.pairings)
      largest[pairing.measurement] = std::max(largest[pairing.measurement], pairing.size);
    Eigen::Index rows = 0;
    for (const auto& [measurement, size] : largest) rows += size;
    root_.setZero(rows, rows);
    solved_.setZero(rows);
  }

  struct Step {
    double chi2, cost;
  };
  /// The chi-square and cost that one more pairing would add. Its rows are in the factor until the next attempt; keep()
  /// keeps them.
  Step attempt(std::size_t pairing) {
    const PairingRows& added = innovation_.pairings[pairing];
    const auto n = added.size;
    Eigen::MatrixXd across(rows_, n);
    Eigen::Index row = 0;
    for (const std::size_t other : chosen_) {
      const PairingRows& rows = innovation_.pairings[other];
      across.middleRows(row, rows.size) = innovation_.covariance.block(rows.first, added.first, rows.size, n);
      row += rows.size;
    }
    root_.topLeftCorner(rows_, rows_).triangularView<Eigen::Lower>().solveInPlace(across);
    const Eigen::MatrixXd left =
        innovation_.covariance.block(added.first, added.first, n, n) - across.transpose() * across;
    const Eigen::MatrixXd own = left.llt().matrixL();
    Eigen::VectorXd residual = innovation_.residual.segment(added.first, n) - across.transpose() * solved_.head(rows_);
    own.triangularView<Eigen::Lower>().solveInPlace(residual);
    root_.block(rows_, 0, n, rows_) = across.transpose();
    root_.block(rows_, rows_, n, n) = own;
    solved_.segment(rows_, n) = residual;
    const double chi2 = residual.squaredNorm();
    return {chi2, chi2 + 2 * own.diagonal().array().log().sum()};
  }
  /// Keeps the pairing that was attempted last.
  void keep(std::size_t pairing, const Step& step) {
    rows_ += innovation_.pairings[pairing].size;
    chi2_ += step.chi2;
    chosen_.push_back(pairing);
  }
  void drop(const Step& step) {
    rows_ -= innovation_.pairings[chosen_.back()].size;
    chi2_ -= step.chi2;
    chosen_.pop_back();
  }

  Eigen::Index rows() const { return rows_; }
  double chi2() const { return chi2_; }
  const std::vector<std::size_t>& chosen() const { return chosen_; }

 private:
  const JointInnovation& innovation_;
  Eigen::MatrixXd root_;
  Eigen::VectorXd solved_;
  Eigen::Index rows_ = 0;
  double chi2_ = 0;
  std::vector<std::size_t> chosen_;
};

class Search {
 public:
  Search(const JointInnovation& innovation, std::size_t measurements, const SearchOptions& options)
      : innovation_(innovation),
        options_(options),
        candidates_(innovation.byMeasurement(measurements)),
        branch_(innovation),
        cheapest_with_(innovation.pairings.size(), kNever) {
    // Measurements with the fewest candidates come first, because certain matches constrain the uncertain ones most.
    order_.resize(measurements);
    std::iota(order_.begin(), order_.end(), std::size_t{0});
    order_.erase(std::remove_if(order_.begin(), order_.end(), [this](std::size_t m) { return candidates_[m].empty(); }),
                 order_.end());
    std::stable_sort(order_.begin(), order_.end(),
                     [this](std::size_t a, std::size_t b) { return candidates_[a].size() < candidates_[b].size(); });
    best_.pairing_of.resize(measurements);
    best_.rival_of.resize(measurements);
  }

  Interpretation run() {
    descend(0, 0);
    best_.nodes = nodes_;
    best_.complete = nodes_ < options_.max_nodes;
    for (const std::size_t m : order_) {
      if (best_.pairing_of[m]) best_.rival_of[m] = rivalOf(m, *best_.pairing_of[m]);
    }
    return best_;
  }

 private:
  void descend(std::size_t depth, double cost) {
    // The first descent is always completed, whatever it costs, so that there is a result.
    if (cost >= best_cost_ + options_.margin || (nodes_ >= options_.max_nodes && best_cost_ < kNever)) return;
    if (depth == order_.size()) return finish(cost);
    const std::size_t m = order_[depth];
    struct Child {
      std::size_t pairing;
      double cost;
    };
    std::vector<Child> children;
    for (const std::size_t pairing : candidates_[m]) {
      if (!innovation_.repeats && isTaken(innovation_.pairings[pairing].landmark)) continue;
      ++nodes_;
      const auto step = branch_.attempt(pairing);
      const auto rows = branch_.rows() + innovation_.pairings[pairing].size;
      // By rounding, or by values in a log, a covariance may not be positive definite; then the cost is not finite.
      const bool is_valid = std::isfinite(step.cost);
      if (is_valid && branch_.chi2() + step.chi2 <= chi2Limit(options_.confidence, rows))
        children.push_back({pairing, step.cost});
    }
    std::stable_sort(children.begin(), children.end(), [](const Child& a, const Child& b) { return a.cost < b.cost; });
    // An unmatched measurement costs as much as its likeliest pairing at the limit of the gate.
    const PairingRows& likeliest = innovation_.pairings[candidates_[m].front()];
    const double alone = likeliest.cost - likeliest.chi2 + likeliest.limit;
    bool left_alone = false;
    for (const Child& child : children) {
      if (!left_alone && child.cost > alone) {
        descend(depth + 1, cost + alone);
        left_alone = true;
      }
      const auto step = branch_.attempt(child.pairing);
      branch_.keep(child.pairing, step);
      descend(depth + 1, cost + child.cost);
      branch_.drop(step);
    }
    if (!left_alone) descend(depth + 1, cost + alone);
  }

  void finish(double cost) {
    for (const std::size_t pairing : branch_.chosen())
      cheapest_with_[pairing] = std::min(cheapest_with_[pairing], cost);
    if (cost >= best_cost_) return;
    best_cost_ = cost;
    best_.chi2 = branch_.chi2();
    best_.rows = branch_.rows();
    std::fill(best_.pairing_of.begin(), best_.pairing_of.end(), std::nullopt);
    for (const std::size_t pairing : branch_.chosen())
      best_.pairing_of[innovation_.pairings[pairing].measurement] = pairing;
  }

  bool isTaken(std::size_t landmark) const {
    const auto& chosen = branch_.chosen();
    return std::any_of(chosen.begin(), chosen.end(),
                       [&](std::size_t pairing) { return innovation_.pairings[pairing].landmark == landmark; });
  }

  std::optional<Interpretation::Rival> rivalOf(std::size_t measurement, std::size_t taken) const {
    std::optional<Interpretation::Rival> rival;
    for (const std::size_t pairing : candidates_[measurement]) {
      const double dearer = cheapest_with_[pairing] - best_cost_;
      if (pairing == taken || dearer > options_.margin) continue;
      if (!rival || dearer < rival->dearer) rival = {pairing, dearer};
    }
    return rival;
  }

  const JointInnovation& innovation_;
  const SearchOptions& options_;
  std::vector<std::vector<std::size_t>> candidates_;  // by measurement
  std::vector<std::size_t> order_;                    // of measurements
  Branch branch_;
  std::vector<double> cheapest_with_;  // by pairing: cost of the best interpretation with it
  double best_cost_ = kNever;
  Interpretation best_;
  int nodes_ = 0;
};

}  // namespace

std::vector<std::vector<std::size_t>> JointInnovation::byMeasurement(std::size_t measurements) const {
  std::vector<std::vector<std::size_t>> passing(measurements);
  for (std::size_t i = 0; i < pairings.size(); ++i)
    if (pairings[i].chi2 <= pairings[i].limit) passing.at(pairings[i].measurement).push_back(i);
  for (auto& some : passing)
    std::stable_sort(some.begin(), some.end(),
                     [this](std::size_t a, std::size_t b) { return pairings[a].cost < pairings[b].cost; });
  return passing;
}

Interpretation searchJointly(const JointInnovation& innovation, std::size_t measurements,
                             const SearchOptions& options) {
  return Search(innovation, measurements, options).run();
}

Interpretation matchNearest(const JointInnovation& innovation, std::size_t measurements) {
  Interpretation found;
  found.pairing_of.resize(measurements);
  found.rival_of.resize(measurements);
  std::vector<std::size_t> order;
  for (const auto& some : innovation.byMeasurement(measurements)) order.insert(order.end(), some.begin(), some.end());
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return innovation.pairings[a].cost < innovation.pairings[b].cost;
  });
  std::vector<std::size_t> taken;
  for (const std::size_t i : order) {
    const PairingRows& pairing = innovation.pairings[i];
    ++found.nodes;
    if (found.pairing_of[pairing.measurement]) continue;
    if (!innovation.repeats && std::count(taken.begin(), taken.end(), pairing.landmark) > 0) continue;
    found.pairing_of[pairing.measurement] = i;
    taken.push_back(pairing.landmark);
    found.chi2 += pairing.chi2;
    found.rows += pairing.size;
  }
  return found;
}

double chi2Limit(double confidence, Eigen::Index rows) {
  // Computing a quantile takes as long as a node of the search, so the results are kept.
  thread_local struct {
    double confidence = 0;
    std::array<double, 256> limits{};
  } known;
  if (known.confidence != confidence) {
    known.confidence = confidence;
    known.limits.fill(0);
  }
  const auto place = static_cast<std::size_t>(rows);
  if (rows == 0) return 0;
  if (place >= known.limits.size()) return graph::chiSquareQuantile(confidence, static_cast<int>(rows));
  if (!(known.limits[place] > 0)) {
    known.limits[place] = graph::chiSquareQuantile(confidence, static_cast<int>(rows));
  }
  return known.limits[place];
}

}  // namespace omnimapper::mapper
