#include "omnimapper/graph/GrownMarginals.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <map>

#include "omnimapper/graph/Linearised.h"

namespace omnimapper::graph {

namespace {

using base::VariableId;

/// Variables with a place each in one stacked tangent.
class Stack {
 public:
  explicit Stack(const Graph& graph) : graph_(&graph) {}
  bool add(VariableId id) {
    if (!offsets_.emplace(id, size_).second) return false;
    ids_.push_back(id);
    size_ += tangentSize(id);
    return true;
  }
  bool contains(VariableId id) const { return offsets_.count(id) > 0; }
  int offset(VariableId id) const { return offsets_.at(id); }
  int tangentSize(VariableId id) const { return graph_->variable(id).kind->tangentSize(); }
  int size() const { return size_; }
  const std::vector<VariableId>& ids() const { return ids_; }

 private:
  const Graph* graph_;
  std::map<VariableId, int> offsets_;
  std::vector<VariableId> ids_;
  int size_ = 0;
};

/// What came since and bears on `ids`, the nearest first, `most` variables of it, and the older ones that they hang on.
/// Factors that lead on to what is left out are left out too: that much less is known.
struct Growth {
  Stack fresh, older;
  std::vector<base::FactorId> factors;
  bool is_whole = true;

  Growth(const Marginals& before, const Graph& grown, const std::vector<VariableId>& ids, std::size_t most)
      : fresh(grown), older(grown) {
    const auto is_fresh = [&](VariableId id) { return !grown.variable(id).fixed && !before.contains(id); };
    for (const VariableId id : ids)
      if (is_fresh(id)) fresh.add(id);
    for (std::size_t next = 0; next < fresh.ids().size(); ++next)
      eachFactor(grown, fresh.ids()[next], [&](base::FactorId, const FactorRecord& record) {
        for (const VariableId id : record.variables) {
          if (!is_fresh(id) || fresh.contains(id)) continue;
          if (fresh.ids().size() < most) {
            fresh.add(id);
          } else {
            is_whole = false;
          }
        }
      });
    for (const VariableId id : ids)
      if (before.contains(id) && !grown.variable(id).fixed) older.add(id);
    for (const VariableId one : fresh.ids())
      eachFactor(grown, one, [&](base::FactorId factor, const FactorRecord& record) {
        const auto leads_on = [&](VariableId id) { return is_fresh(id) && !fresh.contains(id); };
        if (std::any_of(record.variables.begin(), record.variables.end(), leads_on)) return;
        factors.push_back(factor);
        for (const VariableId id : record.variables)
          if (before.contains(id) && !grown.variable(id).fixed) older.add(id);
      });
    std::sort(factors.begin(), factors.end());
    factors.erase(std::unique(factors.begin(), factors.end()), factors.end());
  }

 private:
  template <class Take>
  static void eachFactor(const Graph& graph, VariableId id, Take take) {
    for (const auto factor : graph.factorsOf(id)) {
      const FactorRecord& record = graph.factor(factor);
      if (record.weight > 0) take(factor, record);
    }
  }
};

/// How the new ones follow the older ones, and what is uncertain of them beside that.
struct Following {
  Eigen::MatrixXd by_older, own_covariance;
};

std::optional<Following> follow(const Graph& graph, const Growth& growth) {
  Eigen::MatrixXd information = Eigen::MatrixXd::Zero(growth.fresh.size(), growth.fresh.size());
  Eigen::MatrixXd coupling = Eigen::MatrixXd::Zero(growth.fresh.size(), growth.older.size());
  for (const auto id : growth.factors) {
    const FactorRecord& record = graph.factor(id);
    const Linearised linearised(graph, record);
    const double weight = record.weight * record.loss.evaluate(linearised.residual.squaredNorm()).first_derivative;
    for (std::size_t i = 0; i < record.variables.size(); ++i) {
      if (!growth.fresh.contains(record.variables[i])) continue;
      const int row = growth.fresh.offset(record.variables[i]);
      for (std::size_t j = 0; j < record.variables.size(); ++j) {
        const VariableId other = record.variables[j];
        const Eigen::MatrixXd part = weight * linearised.jacobians[i].transpose() * linearised.jacobians[j];
        if (growth.fresh.contains(other)) {
          information.block(row, growth.fresh.offset(other), part.rows(), part.cols()) += part;
        } else if (growth.older.contains(other)) {
          coupling.block(row, growth.older.offset(other), part.rows(), part.cols()) += part;
        }
      }
    }
  }
  // Scaled to a unit diagonal, so that metres and radians are alike when what is determined by nothing is looked for.
  constexpr double kNothing = 1e-12;
  const Eigen::VectorXd diagonal = information.diagonal();
  if (diagonal.size() > 0 && !(diagonal.minCoeff() > 0)) return std::nullopt;
  const Eigen::VectorXd scale = diagonal.cwiseSqrt().cwiseInverse();
  const Eigen::LDLT<Eigen::MatrixXd> root(scale.asDiagonal() * information * scale.asDiagonal());
  if (root.info() != Eigen::Success) return std::nullopt;
  if (diagonal.size() > 0 && !(root.vectorD().minCoeff() > kNothing)) return std::nullopt;
  const Eigen::MatrixXd scaled = scale.asDiagonal();
  return Following{-scaled * root.solve(scaled * coupling), scaled * root.solve(scaled)};
}

}  // namespace

std::optional<Eigen::MatrixXd> jointCovariance(const Marginals& before, const Graph& grown,
                                               const std::vector<VariableId>& ids) {
  if (!std::all_of(ids.begin(), ids.end(), [&](VariableId id) { return grown.contains(id); })) return std::nullopt;
  // What is far along the trajectory tells next to nothing, unless nothing near does.
  constexpr std::size_t kNear = 48;
  std::size_t most = kNear;
  Growth growth(before, grown, ids, most);
  auto following = follow(grown, growth);
  while (!following && !growth.is_whole) {
    most *= 4;
    growth = Growth(before, grown, ids, most);
    following = follow(grown, growth);
  }
  if (!following) return std::nullopt;
  const Eigen::MatrixXd older =
      growth.older.size() > 0 ? before.jointCovariance(growth.older.ids()) : Eigen::MatrixXd(0, 0);
  // Each of `ids` as a linear function of the older ones, and of the new ones' own errors.
  int rows = 0;
  for (const VariableId id : ids) rows += grown.variable(id).kind->tangentSize();
  Eigen::MatrixXd by_older = Eigen::MatrixXd::Zero(rows, growth.older.size());
  Eigen::MatrixXd by_own = Eigen::MatrixXd::Zero(rows, growth.fresh.size());
  int row = 0;
  for (const VariableId id : ids) {
    const int size = grown.variable(id).kind->tangentSize();
    if (growth.older.contains(id)) {
      by_older.block(row, growth.older.offset(id), size, size).setIdentity();
    } else if (growth.fresh.contains(id)) {
      by_older.middleRows(row, size) = following->by_older.middleRows(growth.fresh.offset(id), size);
      by_own.block(row, growth.fresh.offset(id), size, size).setIdentity();
    }
    row += size;
  }
  Eigen::MatrixXd joint = by_older * older * by_older.transpose();
  joint += by_own * following->own_covariance * by_own.transpose();
  return joint;
}

}  // namespace omnimapper::graph
