#include "PoseCycle.h"

#include <omnimapper/geometry/Covariance.h>

#include <Eigen/Cholesky>

#include "omnimapper/graph/Between.h"
#include "omnimapper/graph/VariableKinds.h"

namespace omnimapper::graph {

namespace {

using base::VariableId;
using geometry::Se2;
using geometry::Se3;

template <class Pose>
struct Types;
template <>
struct Types<Se2> {
  using Factor = BetweenSe2;
  static constexpr int kSize = 3;
  static Se2 pose(const Graph& graph, VariableId id) { return se2FromValue(graph.value(id).data()); }
};
template <>
struct Types<Se3> {
  using Factor = BetweenSe3;
  static constexpr int kSize = 6;
  static Se3 pose(const Graph& graph, VariableId id) { return se3FromValue(graph.value(id).data()); }
};

/// A pose relative to another, with its covariance.
template <class Pose>
struct Known {
  using Covariance = Eigen::Matrix<double, Types<Pose>::kSize, Types<Pose>::kSize>;
  Pose pose;
  Covariance covariance;
};

template <class Pose>
Known<Pose> operator*(const Known<Pose>& a, const Known<Pose>& b) {
  return {a.pose * b.pose, geometry::composeCovariance(a.covariance, b.pose, b.covariance)};
}

template <class Pose>
Known<Pose> inverse(const Known<Pose>& a) {
  return {geometry::inverse(a.pose), geometry::inverseCovariance(a.pose, a.covariance)};
}

/// The measurement of a factor, from the older of its poses to the newer.
template <class Pose>
struct Ends {
  VariableId older, newer;
  Known<Pose> older_from_newer;

  Ends(const FactorRecord& record, const typename Types<Pose>::Factor& factor)
      : older(record.variables[0]),
        newer(record.variables[1]),
        older_from_newer{factor.measured(), record.noise.covariance()} {
    if (older < newer) return;
    std::swap(older, newer);
    older_from_newer = inverse(older_from_newer);
  }
};

template <class Pose>
Known<Pose> between(const Graph& graph, const Marginals& marginals, VariableId a, VariableId b, double inflation) {
  Known<Pose> known{geometry::inverse(Types<Pose>::pose(graph, a)) * Types<Pose>::pose(graph, b), {}};
  known.covariance.setZero();
  if (a != b)
    known.covariance =
        inflation * inflation * geometry::betweenCovariance(known.pose, marginals.jointCovariance({a, b}));
  return known;
}

template <class Pose>
std::optional<InnovationStatistics> cycle(const Graph& graph, const Marginals& marginals, const FactorRecord& first,
                                          const FactorRecord& second, double inflation) {
  using Factor = typename Types<Pose>::Factor;
  const auto* const one = dynamic_cast<const Factor*>(first.factor.get());
  const auto* const other = dynamic_cast<const Factor*>(second.factor.get());
  if (!one || !other) return std::nullopt;
  for (const FactorRecord* record : {&first, &second})
    for (const VariableId id : record->variables)
      if (graph.variable(id).kind->tangentSize() != Types<Pose>::kSize) return std::nullopt;
  const Ends<Pose> ij(first, *one), kl(second, *other);
  const Known<Pose> k_from_l = between<Pose>(graph, marginals, kl.older, ij.older, inflation) * ij.older_from_newer *
                               between<Pose>(graph, marginals, ij.newer, kl.newer, inflation);
  const Eigen::LLT<Eigen::MatrixXd> noise(kl.older_from_newer.covariance);
  const Eigen::MatrixXd half = noise.matrixL().solve(k_from_l.covariance);
  InnovationStatistics innovation{noise.matrixL().solve(geometry::minus(k_from_l.pose, kl.older_from_newer.pose)),
                                  noise.matrixL().solve(half.transpose())};
  innovation.covariance.diagonal().array() += 1;
  return innovation;
}

}  // namespace

std::optional<InnovationStatistics> poseCycle(const Graph& graph, const Marginals& marginals, base::FactorId first,
                                              base::FactorId second, double inflation) {
  const FactorRecord &one = graph.factor(first), &other = graph.factor(second);
  if (auto planar = cycle<Se2>(graph, marginals, one, other, inflation)) return planar;
  return cycle<Se3>(graph, marginals, one, other, inflation);
}

}  // namespace omnimapper::graph
