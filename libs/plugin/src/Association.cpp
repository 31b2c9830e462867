#include <omnimapper/graph/Linearized.h>
#include <omnimapper/plugin/Association.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "JointCompatibility.h"

namespace omnimapper::mapper {

namespace {

// A pairing, linearized at the current values, with its gate and cost.
struct Candidate {
  std::size_t pairing;
  graph::Linearized linearized;
  double chi2 = 0, limit = 0, cost = 0;
};

// The variables that the candidates bind, with their offsets in one stacked tangent.
struct Places {
  std::map<base::VariableId, Eigen::Index> offsets;
  std::vector<base::VariableId> ids;
  Eigen::Index size = 0;

  Places(const std::vector<Candidate>& candidates, const std::vector<Pairing>& pairings, const graph::Graph& graph) {
    for (const auto& candidate : candidates) {
      for (const auto id : pairings[candidate.pairing].record.variables) {
        if (!offsets.emplace(id, size).second) continue;
        ids.push_back(id);
        size += graph.variable(id).kind->tangentSize();
      }
    }
  }
};

// Blocks of the covariance of the predicted residuals, from the covariance of the variables.
class Prediction {
 public:
  Prediction(const std::vector<Pairing>& pairings, const Places& places, Eigen::MatrixXd covariance)
      : pairings_(pairings), places_(places), covariance_(std::move(covariance)) {}

  // J_a cov J_b^T
  Eigen::MatrixXd between(const Candidate& a, const Candidate& b) const {
    Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(a.linearized.residual.size(), b.linearized.residual.size());
    const auto& of_a = pairings_[a.pairing].record.variables;
    const auto& of_b = pairings_[b.pairing].record.variables;
    for (std::size_t i = 0; i < of_a.size(); ++i) {
      for (std::size_t j = 0; j < of_b.size(); ++j) {
        const auto &by_a = a.linearized.jacobians[i], &by_b = b.linearized.jacobians[j];
        sum += by_a *
               covariance_.block(places_.offsets.at(of_a[i]), places_.offsets.at(of_b[j]), by_a.cols(), by_b.cols()) *
               by_b.transpose();
      }
    }
    return sum;
  }

 private:
  const std::vector<Pairing>& pairings_;
  const Places& places_;
  const Eigen::MatrixXd covariance_;
};

bool isBound(const Pairing& pairing, const graph::Graph& graph) {
  const auto& variables = pairing.record.variables;
  return std::all_of(variables.begin(), variables.end(), [&](base::VariableId id) {
    if (graph.variable(id).fixed) return true;
    const auto& factors = graph.factorsOf(id);
    return std::any_of(factors.begin(), factors.end(),
                       [&](base::FactorId factor) { return graph.factor(factor).weight > 0; });
  });
}

// Computes the gate and cost of each candidate by itself.
void gate(std::vector<Candidate>& candidates, const Prediction& prediction, const AssociationOptions& options) {
  for (Candidate& candidate : candidates) {
    const Eigen::VectorXd& residual = candidate.linearized.residual;
    Eigen::MatrixXd covariance = Eigen::MatrixXd::Identity(residual.size(), residual.size());
    covariance += options.inflation * options.inflation * prediction.between(candidate, candidate);
    const Eigen::LLT<Eigen::MatrixXd> root(covariance);
    candidate.chi2 = residual.dot(root.solve(residual));
    candidate.limit = chi2Limit(options.confidence, residual.size());
    candidate.cost = candidate.chi2 + 2 * Eigen::MatrixXd(root.matrixL()).diagonal().array().log().sum();
    // A covariance that is not positive definite gives no cost to compare, so the candidate is refused.
    if (root.info() != Eigen::Success || !std::isfinite(candidate.cost))
      candidate.chi2 = candidate.cost = std::numeric_limits<double>::infinity();
  }
}

// The candidates that pass their gates, only the best of each measurement, in the order of pairings.
std::vector<const Candidate*> passing(const std::vector<Candidate>& candidates, const std::vector<Pairing>& pairings,
                                      std::size_t measurements) {
  constexpr std::size_t kMost = 32;
  std::vector<std::vector<const Candidate*>> of_measurement(measurements);
  for (const Candidate& candidate : candidates)
    if (candidate.chi2 <= candidate.limit)
      of_measurement[pairings[candidate.pairing].measurement].push_back(&candidate);
  std::vector<const Candidate*> all;
  for (auto& some : of_measurement) {
    std::stable_sort(some.begin(), some.end(), [](const auto* a, const auto* b) { return a->cost < b->cost; });
    some.resize(std::min(some.size(), kMost));
    all.insert(all.end(), some.begin(), some.end());
  }
  std::sort(all.begin(), all.end(), [](const auto* a, const auto* b) { return a->pairing < b->pairing; });
  return all;
}

JointInnovation innovationOf(const std::vector<const Candidate*>& candidates, const std::vector<Pairing>& pairings,
                             const Prediction& prediction, const AssociationOptions& options) {
  JointInnovation innovation;
  std::map<base::LandmarkId, std::size_t> numbers;
  Eigen::Index rows = 0;
  for (const Candidate* candidate : candidates) {
    const Pairing& pairing = pairings[candidate->pairing];
    const std::size_t landmark = numbers.emplace(pairing.landmark, numbers.size()).first->second;
    const Eigen::Index size = candidate->linearized.residual.size();
    innovation.pairings.push_back(
        {pairing.measurement, landmark, rows, size, candidate->chi2, candidate->limit, candidate->cost});
    rows += size;
  }
  innovation.residual.resize(rows);
  innovation.covariance.setIdentity(rows, rows);
  const double inflation = options.inflation * options.inflation;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const PairingRows& at = innovation.pairings[i];
    innovation.residual.segment(at.first, at.size) = candidates[i]->linearized.residual;
    for (std::size_t j = 0; j <= i; ++j) {
      const PairingRows& other = innovation.pairings[j];
      const Eigen::MatrixXd block = inflation * prediction.between(*candidates[i], *candidates[j]);
      innovation.covariance.block(at.first, other.first, at.size, other.size) += block;
      if (i != j) innovation.covariance.block(other.first, at.first, other.size, at.size) += block.transpose();
    }
  }
  return innovation;
}

// The pairing that each measurement fits best by itself; it is reported for measurements that are not matched.
std::vector<const Candidate*> nearest(const std::vector<Candidate>& candidates, const std::vector<Pairing>& pairings,
                                      std::size_t measurements) {
  std::vector<const Candidate*> best(measurements, nullptr);
  for (const Candidate& candidate : candidates) {
    const Candidate*& so_far = best[pairings[candidate.pairing].measurement];
    if (!so_far || candidate.chi2 < so_far->chi2) so_far = &candidate;
  }
  return best;
}

}  // namespace

Association associate(std::size_t measurements, const std::vector<Pairing>& pairings, const State& state,
                      const AssociationOptions& options, Repeats repeats) {
  Association association;
  association.matches.resize(measurements);
  std::vector<Candidate> candidates;
  for (std::size_t i = 0; i < pairings.size(); ++i)
    if (isBound(pairings[i], state.graph))
      candidates.push_back({i, graph::Linearized(state.graph, pairings[i].record)});
  if (candidates.empty()) return association;
  const Places places(candidates, pairings, state.graph);
  auto joint = state.jointCovariance(places.ids);
  if (!joint) {
    for (const Candidate& candidate : candidates) {
      Match& match = association.matches[pairings[candidate.pairing].measurement];
      match.kind = Match::Kind::undetermined;
      match.pairing = candidate.pairing;
    }
    return association;
  }
  const Prediction prediction(pairings, places, std::move(*joint));
  gate(candidates, prediction, options);
  const auto near = passing(candidates, pairings, measurements);
  JointInnovation innovation = innovationOf(near, pairings, prediction, options);
  innovation.repeats = repeats == Repeats::yes;
  const bool jointly = options.method == AssociationOptions::Method::joint;
  const double margin = 2 * std::log(options.min_likelihood_ratio);
  const Interpretation found =
      jointly ? searchJointly(innovation, measurements, {options.confidence, margin, options.max_nodes})
              : matchNearest(innovation, measurements);
  const auto nearest_of = nearest(candidates, pairings, measurements);
  for (std::size_t m = 0; m < measurements; ++m) {
    Match& match = association.matches[m];
    const Candidate* taken = found.pairing_of[m] ? near[*found.pairing_of[m]] : nearest_of[m];
    if (!taken) continue;
    match.pairing = taken->pairing;
    match.chi2 = taken->chi2;
    match.limit = taken->limit;
    if (!found.pairing_of[m]) continue;
    match.kind = Match::Kind::matched;
    if (const auto& rival = found.rival_of[m]) {
      match.rival = pairings[near[rival->pairing]->pairing].landmark;
      match.likelihood_ratio = std::exp(0.5 * rival->dearer);
      if (match.likelihood_ratio < options.min_likelihood_ratio) match.kind = Match::Kind::ambiguous;
    }
  }
  association.chi2 = found.chi2;
  association.limit = chi2Limit(options.confidence, found.rows);
  association.nodes = found.nodes;
  association.complete = found.complete;
  return association;
}

void Match::describe(Decision& decision) const {
  decision.accepted = kind == Kind::matched;
  if (pairing) {
    decision.numbers.emplace_back("chi-square", chi2);
    decision.numbers.emplace_back("limit", limit);
  }
  if (rival) decision.numbers.emplace_back("times likelier than the next", likelihood_ratio);
  switch (kind) {
    case Kind::matched:
      decision.reason = "matched";
      break;
    case Kind::ambiguous:
      decision.reason = "fits two landmarks about equally well";
      break;
    case Kind::undetermined:
      decision.reason = "the covariance is unknown: left out";
      break;
    case Kind::unknown:
      decision.reason = !pairing       ? "none is near"
                        : chi2 > limit ? "gated out: too far from the nearest"
                                       : "does not fit together with the others";
      break;
  }
}

void Association::describe(std::size_t measurement, Decision& decision) const {
  matches[measurement].describe(decision);
  if (complete) return;
  decision.reason += "; the search was cut short";
  decision.numbers.emplace_back("interpretations", nodes);
}

}  // namespace omnimapper::mapper
