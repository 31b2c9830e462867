#include <omnimapper/base/Error.h>
#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/geometry/Covariance.h>
#include <omnimapper/graph/MarginalExtrapolation.h>
#include <omnimapper/plugin/Uncertainty.h>

#include <Eigen/LU>
#include <mutex>

namespace omnimapper::mapper {

namespace {

using geometry::Matrix6d;

// Covariance of the motion between two successive key frames, by the factors between just these two, as if each
// measured the motion itself. None if there are no such factors.
std::optional<Matrix6d> ofStep(const graph::Graph& graph, const map::KeyFrame& from, const map::KeyFrame& to) {
  const int size = graph.variable(to.pose).kind->tangentSize();
  Eigen::MatrixXd information = Eigen::MatrixXd::Zero(size, size);
  for (const auto id : graph.factorsOf(to.pose)) {
    const auto& record = graph.factor(id);
    const bool binds_both = record.variables == std::vector<base::VariableId>{from.pose, to.pose};
    if (binds_both && record.noise.size() == size) information += record.weight * record.noise.information();
  }
  const Eigen::FullPivLU<Eigen::MatrixXd> lu(information);
  if (!lu.isInvertible()) return std::nullopt;
  const Eigen::MatrixXd covariance = lu.inverse();
  return size == 3 ? geometry::embedPlanar(Eigen::Matrix3d(covariance)) : Matrix6d(covariance);
}

}  // namespace

struct Uncertainty::Solved {
  explicit Solved(const graph::Graph& g) : graph(g) {}
  Solved(const graph::Graph& g, graph::Marginals marginals) : graph(g), made(std::move(marginals)) {}

  const std::optional<graph::Marginals>& marginals() const {
    std::call_once(once, [this] {
      if (made) return;
      try {
        made.emplace(graph);
      } catch (const base::Error&) {
        made.reset();  // some variable is unconstrained
      }
    });
    return made;
  }

  const graph::Graph graph;
  mutable std::once_flag once;
  mutable std::optional<graph::Marginals> made;
};

Uncertainty::Uncertainty(const graph::Graph& graph) : solved_(std::make_shared<const Solved>(graph)) {}

Uncertainty::Uncertainty(const graph::Graph& graph, graph::Marginals marginals)
    : solved_(std::make_shared<const Solved>(graph, std::move(marginals))) {}

std::optional<Matrix6d> Uncertainty::between(const map::Map& map, const graph::Graph& graph, base::KeyFrameId from,
                                             base::KeyFrameId to) const {
  if (!solved_) return std::nullopt;
  const auto& frames = map.key_frames;
  const map::KeyFrame& begin = frames.at(from);
  // Goes back along the trajectory from `to`, until a key frame that the factorized graph has, or until `from`.
  std::size_t known = frames.position(to);
  const std::size_t last = known;
  while (frames[known].id != from && !solved_->graph.contains(frames[known].pose)) {
    if (known == 0 || frames[known - 1].id.session != to.session) return std::nullopt;
    --known;
  }
  Matrix6d covariance = Matrix6d::Zero();
  if (frames[known].id != from) {
    if (!solved_->graph.contains(begin.pose)) return std::nullopt;
    const auto& marginals = solved_->marginals();
    if (!marginals) return std::nullopt;
    const auto from_from_known = geometry::fromMrpt(frames[known].map_from_base - begin.map_from_base);
    const Eigen::MatrixXd both = marginals->jointCovariance({begin.pose, frames[known].pose});
    covariance =
        both.rows() == 6
            ? geometry::embedPlanar(geometry::betweenCovariance(geometry::project(from_from_known), Matrix6d(both)))
            : geometry::betweenCovariance(from_from_known, Eigen::Matrix<double, 12, 12>(both));
  }
  for (std::size_t i = known + 1; i <= last; ++i) {
    const auto step = geometry::fromMrpt(frames[i].map_from_base - frames[i - 1].map_from_base);
    const auto of_step = ofStep(graph, frames[i - 1], frames[i]);
    if (!of_step) return std::nullopt;
    covariance = geometry::composeCovariance(covariance, step, *of_step);
  }
  return covariance;
}

std::optional<Eigen::MatrixXd> Uncertainty::joint(const graph::Graph& graph,
                                                  const std::vector<base::VariableId>& ids) const {
  if (!solved_ || !solved_->marginals()) return std::nullopt;
  return graph::jointCovariance(*solved_->marginals(), graph, ids);
}

}  // namespace omnimapper::mapper
