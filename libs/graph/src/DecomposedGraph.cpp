#include <omnimapper/base/Error.h>

#include <algorithm>
#include <unordered_map>

#include "GaugeCheck.h"
#include "MarginalSource.h"
#include "NormalEquations.h"
#include "SparseCholesky.h"

namespace omnimapper::graph {

namespace {

// The number of entries that both vectors have. Both follow paths to the root of the elimination tree, which are the
// same from the row where they meet, so the common entries are at the end of both.
std::size_t common(const SparseVector& a, const SparseVector& b) {
  std::size_t alike = 0, different = std::min(a.rows.size(), b.rows.size()) + 1;
  while (alike + 1 < different) {
    const std::size_t tried = (alike + different) / 2;
    (a.rows[a.rows.size() - tried] == b.rows[b.rows.size() - tried] ? alike : different) = tried;
  }
  return alike;
}

double dot(const SparseVector& a, const SparseVector& b) {
  const auto shared = static_cast<Eigen::Index>(common(a, b));
  const auto tail = [&](const SparseVector& vector) {
    return Eigen::Map<const Eigen::VectorXd>(vector.values.data() + vector.values.size() - shared, shared);
  };
  return tail(a).dot(tail(b));
}

/// The matrix as a whole; a place is the first row. Keeps the half-solved columns.
class DecomposedGraph : public MarginalSource {
 public:
  explicit DecomposedGraph(const Graph& graph) {
    checkGauge(graph);
    NormalEquations equations(graph);
    equations.linearize(equations.values(graph));
    for (const auto& [id, record] : graph.variables())
      if (!record.fixed && equations.contains(id)) places_[id] = {equations.offset(id), record.kind->tangentSize()};
    rows_ = equations.information().size;
    if (rows_ == 0) return;
    cholesky_ = std::make_unique<SparseCholesky>(equations.information(), equations.groups());
    if (!cholesky_->factorize(equations.information(), SparseCholesky::Storage::columns))
      throw base::Error(base::ExitCode::internal,
                        "marginals: the information matrix is singular: some direction of a variable is undetermined; "
                        "add a prior or another factor there");
  }

  std::optional<Place> find(base::VariableId id) const override {
    const auto found = places_.find(id);
    return found == places_.end() ? std::nullopt : std::optional<Place>(found->second);
  }
  Eigen::MatrixXd block(Place a, Place b) override {
    const auto &left = halves(a), &right = halves(b);
    Eigen::MatrixXd block(a.size, b.size);
    for (int i = 0; i < a.size; ++i)
      for (int j = 0; j < b.size; ++j)
        block(i, j) = dot(left[static_cast<std::size_t>(i)], right[static_cast<std::size_t>(j)]);
    return block;
  }
  std::vector<Eigen::MatrixXd> column(Place a, const std::vector<Place>& others) override {
    // The columns are solved as a whole, which is cheaper than a path through the factor for each of the others.
    Eigen::MatrixXd columns = Eigen::MatrixXd::Zero(rows_, a.size);
    for (int i = 0; i < a.size; ++i) columns(a.number + i, i) = 1;
    columns = cholesky_->solve(columns);
    std::vector<Eigen::MatrixXd> blocks;
    for (const Place other : others) blocks.emplace_back(columns.middleRows(other.number, other.size));
    return blocks;
  }
  std::size_t kept() const override { return kept_; }
  void forget() override {
    halves_.clear();
    kept_ = 0;
  }

 private:
  const std::vector<SparseVector>& halves(Place place) {
    auto& columns = halves_[place.number];
    for (int i = static_cast<int>(columns.size()); i < place.size; ++i) {
      columns.push_back(cholesky_->halfSolve(place.number + i));
      kept_ += 2 * columns.back().rows.size();
    }
    return columns;
  }

  std::unordered_map<base::VariableId, Place> places_;
  int rows_ = 0;
  std::unique_ptr<SparseCholesky> cholesky_;
  std::unordered_map<int, std::vector<SparseVector>> halves_;
  std::size_t kept_ = 0;
};

}  // namespace

std::unique_ptr<MarginalSource> decomposed(const Graph& graph) {
  return std::make_unique<DecomposedGraph>(graph);
}

}  // namespace omnimapper::graph
