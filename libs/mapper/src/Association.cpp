#include <omnimapper/graph/Linearised.h>
#include <omnimapper/mapper/Association.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <map>

#include "JointCompatibility.h"

namespace omnimapper::mapper {

namespace {

// Variables that the pairings bind, each with a place in one stacked tangent.
struct Places {
  std::map<base::VariableId, Eigen::Index> offsets;
  std::vector<base::VariableId> ids;
  Eigen::Index size = 0;

  Places(const std::vector<Pairing>& pairings, const graph::Graph& graph) {
    for (const auto& pairing : pairings) {
      for (const auto id : pairing.record.variables) {
        if (!offsets.emplace(id, size).second) continue;
        ids.push_back(id);
        size += graph.variable(id).kind->tangentSize();
      }
    }
  }
};

std::vector<std::size_t> landmarkNumbers(const std::vector<Pairing>& pairings) {
  std::map<base::LandmarkId, std::size_t> numbers;
  std::vector<std::size_t> of_pairings;
  for (const auto& pairing : pairings)
    of_pairings.push_back(numbers.emplace(pairing.landmark, numbers.size()).first->second);
  return of_pairings;
}

JointInnovation innovationOf(const std::vector<Pairing>& pairings, const State& state,
                             const AssociationOptions& options) {
  const Places places(pairings, state.graph);
  const auto landmarks = landmarkNumbers(pairings);
  JointInnovation innovation;
  Eigen::Index rows = 0;
  for (const auto& pairing : pairings) rows += pairing.record.factor->residualSize();
  innovation.residual.resize(rows);
  Eigen::MatrixXd jacobian = Eigen::MatrixXd::Zero(rows, places.size);
  rows = 0;
  for (std::size_t i = 0; i < pairings.size(); ++i) {
    const auto& record = pairings[i].record;
    const graph::Linearised linearised(state.graph, record);
    const Eigen::Index size = linearised.residual.size();
    innovation.pairings.push_back({pairings[i].measurement, landmarks[i], rows, size, 0, 0, 0});
    innovation.residual.segment(rows, size) = linearised.residual;
    for (std::size_t k = 0; k < record.variables.size(); ++k) {
      const auto& part = linearised.jacobians[k];
      jacobian.block(rows, places.offsets.at(record.variables[k]), size, part.cols()) = part;
    }
    rows += size;
  }
  innovation.covariance.setIdentity(rows, rows);
  if (const auto joint = state.jointCovariance(places.ids)) {
    innovation.covariance += options.inflation * options.inflation * jacobian * *joint * jacobian.transpose();
  }
  for (auto& pairing : innovation.pairings) {
    const Eigen::LLT<Eigen::MatrixXd> root(
        innovation.covariance.block(pairing.first, pairing.first, pairing.size, pairing.size));
    const Eigen::VectorXd residual = innovation.residual.segment(pairing.first, pairing.size);
    pairing.chi2 = residual.dot(root.solve(residual));
    pairing.limit = chi2Limit(options.confidence, pairing.size);
    pairing.cost = pairing.chi2 + 2 * Eigen::MatrixXd(root.matrixL()).diagonal().array().log().sum();
  }
  return innovation;
}

// The best fit of a measurement by itself, for what is said of one that was not matched.
std::optional<std::size_t> nearest(const JointInnovation& innovation, std::size_t measurement) {
  std::optional<std::size_t> best;
  for (std::size_t i = 0; i < innovation.pairings.size(); ++i) {
    if (innovation.pairings[i].measurement != measurement) continue;
    if (!best || innovation.pairings[i].chi2 < innovation.pairings[*best].chi2) best = i;
  }
  return best;
}

}  // namespace

Association associate(std::size_t measurements, const std::vector<Pairing>& pairings, const State& state,
                      const AssociationOptions& options, Repeats repeats) {
  Association association;
  association.matches.resize(measurements);
  if (pairings.empty()) return association;
  JointInnovation innovation = innovationOf(pairings, state, options);
  innovation.repeats = repeats == Repeats::yes;
  const bool jointly = options.method == AssociationOptions::Method::joint;
  const double margin = 2 * std::log(options.min_likelihood_ratio);
  const Interpretation found =
      jointly ? searchJointly(innovation, measurements, {options.confidence, margin, options.max_nodes})
              : matchNearest(innovation, measurements);
  for (std::size_t m = 0; m < measurements; ++m) {
    Match& match = association.matches[m];
    match.pairing = found.pairing_of[m] ? found.pairing_of[m] : nearest(innovation, m);
    if (!match.pairing) continue;
    match.chi2 = innovation.pairings[*match.pairing].chi2;
    match.limit = innovation.pairings[*match.pairing].limit;
    if (!found.pairing_of[m]) continue;
    match.kind = Match::Kind::matched;
    if (const auto& rival = found.rival_of[m]) {
      match.rival = pairings[rival->pairing].landmark;
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

void Match::tell(Decision& decision) const {
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
      decision.reason = "fits two landmarks alike";
      break;
    case Kind::unknown:
      decision.reason = !pairing       ? "none is near"
                        : chi2 > limit ? "gated out: too far from the nearest"
                                       : "does not fit together with the others";
      break;
  }
}

}  // namespace omnimapper::mapper
