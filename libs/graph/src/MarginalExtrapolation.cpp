#include "omnimapper/graph/MarginalExtrapolation.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <map>
#include <set>

#include "omnimapper/graph/Linearized.h"

namespace omnimapper::graph {

namespace {

using base::VariableId;

/// Variables with their offsets in one stacked tangent.
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

/// The new variables that affect `ids`, the nearest first and at most `most` of them, and the older variables that they
/// are attached to. Factors that also bind new variables beyond this limit are left out, which loses only their
/// information.
struct Growth {
  Stack fresh, older;
  int asked = 0;  // number of rows of `fresh` that belong to `ids`; they are the first ones
  std::vector<base::FactorId> factors;
  std::set<VariableId> rim;  // the new variables that are bound by factors that were left out

  Growth(const Marginals& before, const Graph& grown, const std::vector<VariableId>& ids, std::size_t most)
      : fresh(grown), older(grown) {
    const auto is_fresh = [&](VariableId id) { return !grown.variable(id).fixed && !before.contains(id); };
    const auto addOlder = [&](VariableId id) {
      if (!grown.variable(id).fixed && before.contains(id)) older.add(id);
    };
    for (const VariableId id : ids) {
      if (is_fresh(id)) fresh.add(id);
      addOlder(id);
    }
    asked = fresh.size();
    for (std::size_t next = 0; next < fresh.ids().size(); ++next)
      eachFactor(grown, fresh.ids()[next], [&](base::FactorId, const FactorRecord& record) {
        for (const VariableId id : record.variables)
          if (is_fresh(id) && fresh.ids().size() < most) fresh.add(id);
      });
    for (const VariableId one : fresh.ids())
      eachFactor(grown, one, [&](base::FactorId factor, const FactorRecord& record) {
        const auto is_left_out = [&](VariableId id) { return is_fresh(id) && !fresh.contains(id); };
        if (std::any_of(record.variables.begin(), record.variables.end(), is_left_out)) {
          rim.insert(one);
          return;
        }
        factors.push_back(factor);
        for (const VariableId id : record.variables) addOlder(id);
      });
    std::sort(factors.begin(), factors.end());
    factors.erase(std::unique(factors.begin(), factors.end()), factors.end());
  }
  bool isWhole() const { return rim.empty(); }

 private:
  template <class Take>
  static void eachFactor(const Graph& graph, VariableId id, Take take) {
    for (const auto factor : graph.factorsOf(id)) {
      const FactorRecord& record = graph.factor(factor);
      if (record.weight > 0) take(factor, record);
    }
  }
};

/// The requested new variables as linear functions of the older ones, and the covariance of their own errors.
struct Following {
  Eigen::MatrixXd by_older, own_covariance;
};

struct System {
  Eigen::MatrixXd information, coupling;  // of the new variables; between them and the older ones

  System(const Graph& graph, const Growth& growth)
      : information(Eigen::MatrixXd::Zero(growth.fresh.size(), growth.fresh.size())),
        coupling(Eigen::MatrixXd::Zero(growth.fresh.size(), growth.older.size())) {
    for (const auto id : growth.factors) {
      const FactorRecord& record = graph.factor(id);
      const Linearized linearized(graph, record);
      const double weight = record.weight * record.loss.evaluate(linearized.residual.squaredNorm()).first_derivative;
      for (std::size_t i = 0; i < record.variables.size(); ++i) {
        if (!growth.fresh.contains(record.variables[i])) continue;
        const int row = growth.fresh.offset(record.variables[i]);
        for (std::size_t j = 0; j < record.variables.size(); ++j) {
          const VariableId other = record.variables[j];
          const Eigen::MatrixXd part = weight * linearized.jacobians[i].transpose() * linearized.jacobians[j];
          if (growth.fresh.contains(other)) {
            information.block(row, growth.fresh.offset(other), part.rows(), part.cols()) += part;
          } else if (growth.older.contains(other)) {
            coupling.block(row, growth.older.offset(other), part.rows(), part.cols()) += part;
          }
        }
      }
    }
  }
};

// None if some direction of a requested variable is undetermined.
std::optional<Following> follow(const Graph& graph, const Growth& growth) {
  if (growth.asked == 0) return Following{Eigen::MatrixXd(0, growth.older.size()), Eigen::MatrixXd(0, 0)};
  // The system is scaled to a unit diagonal, so that units do not matter when undetermined directions are looked for.
  // Directions at the rim may be undetermined: a trace of information, too little to affect other variables, removes
  // the singularity.
  constexpr double kNothing = 1e-12, kTrace = 1e-9, kOpen = 1e6;
  System system(graph, growth);
  for (const VariableId id : growth.rim) {
    auto diagonal = system.information.diagonal().segment(growth.fresh.offset(id), growth.fresh.tangentSize(id));
    const double largest = diagonal.maxCoeff();
    diagonal = diagonal.cwiseMax(kTrace * largest) * (1 + kTrace);
  }
  const Eigen::VectorXd diagonal = system.information.diagonal();
  if (!(diagonal.minCoeff() > 0)) return std::nullopt;
  const Eigen::VectorXd scale = diagonal.cwiseSqrt().cwiseInverse();
  const Eigen::LLT<Eigen::MatrixXd> root(scale.asDiagonal() * system.information * scale.asDiagonal());
  if (root.info() != Eigen::Success) return std::nullopt;
  const double least = root.matrixLLT().diagonal().minCoeff();
  if (!(least * least > kNothing)) return std::nullopt;
  Eigen::MatrixXd columns = root.solve(Eigen::MatrixXd::Identity(growth.fresh.size(), growth.asked));
  if (!growth.isWhole() && columns.diagonal().maxCoeff() > kOpen) return std::nullopt;
  columns = scale.asDiagonal() * columns * scale.head(growth.asked).asDiagonal();
  return Following{-columns.transpose() * system.coupling, columns.topRows(growth.asked)};
}

}  // namespace

std::optional<Eigen::MatrixXd> jointCovariance(const Marginals& before, const Graph& grown,
                                               const std::vector<VariableId>& ids) {
  if (!std::all_of(ids.begin(), ids.end(), [&](VariableId id) { return grown.contains(id); })) return std::nullopt;
  // Factors far along the trajectory have hardly any effect, unless the near ones leave a direction undetermined.
  constexpr std::size_t kNear = 12;
  std::size_t most = kNear;
  Growth growth(before, grown, ids, most);
  auto following = follow(grown, growth);
  while (!following && !growth.isWhole()) {
    most *= 4;
    growth = Growth(before, grown, ids, most);
    following = follow(grown, growth);
  }
  if (!following) return std::nullopt;
  const Eigen::MatrixXd older =
      growth.older.size() > 0 ? before.jointCovariance(growth.older.ids()) : Eigen::MatrixXd(0, 0);
  // Each of `ids` is a linear function of the older variables and of the errors of the new ones.
  int rows = 0;
  for (const VariableId id : ids) rows += grown.variable(id).kind->tangentSize();
  Eigen::MatrixXd by_older = Eigen::MatrixXd::Zero(rows, growth.older.size());
  Eigen::MatrixXd by_own = Eigen::MatrixXd::Zero(rows, growth.asked);
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
