#include "omnimapper/graph/Marginals.h"

#include <omnimapper/base/Error.h>

#include <cstdint>
#include <mutex>
#include <unordered_map>

#include "MarginalSource.h"

namespace omnimapper::graph {

/// The source, and a cache of blocks, because the same blocks are requested again at the next key frame.
class Marginals::State {
 public:
  State(const Graph& graph, std::unique_ptr<MarginalSource> source) : graph_(graph), source_(std::move(source)) {}

  struct Place {
    bool is_fixed;
    MarginalSource::Place in_source;
  };
  std::optional<Place> find(base::VariableId id) const {
    if (const auto place = source_->find(id)) return Place{false, *place};
    if (!graph_.contains(id) || !graph_.variable(id).fixed) return std::nullopt;
    return Place{true, {-1, graph_.variable(id).kind->tangentSize()}};
  }
  Place at(base::VariableId id) const {
    if (const auto place = find(id)) return *place;
    throw base::Error(
        base::ExitCode::internal,
        "marginals: variable " + toString(id) + " is bound by no factor of positive weight, or is not in the graph");
  }
  /// The block of two variables that are in the source, of which `later` has no smaller number. Valid until
  /// forgetIfMany().
  const Eigen::MatrixXd& block(MarginalSource::Place later, MarginalSource::Place earlier) {
    Eigen::MatrixXd& block =
        blocks_[(static_cast<std::uint64_t>(later.number) << 32) | static_cast<std::uint64_t>(earlier.number)];
    if (block.size() > 0) return block;
    block = source_->block(later, earlier);
    kept_ += kBlock + static_cast<std::size_t>(block.size());
    return block;
  }
  std::vector<Eigen::MatrixXd> column(MarginalSource::Place place, const std::vector<MarginalSource::Place>& others) {
    return source_->column(place, others);
  }
  /// Keeps memory within bounds.
  void forgetIfMany() {
    constexpr std::size_t kMost = 4'000'000;  // numbers
    if (kept_ + source_->kept() < kMost) return;
    blocks_.clear();
    source_->forget();
    kept_ = 0;
  }

  std::mutex mutex;

 private:
  static constexpr std::size_t kBlock = 12;  // memory of a block beside its numbers, in numbers

  const Graph graph_;
  std::unique_ptr<MarginalSource> source_;
  std::unordered_map<std::uint64_t, Eigen::MatrixXd> blocks_;  // by the two numbers
  std::size_t kept_ = 0;
};

Marginals::Marginals(const Graph& graph) : Marginals(graph, decomposed(graph)) {}
Marginals::Marginals(const Graph& graph, std::unique_ptr<MarginalSource> source)
    : state_(std::make_unique<State>(graph, std::move(source))) {}
Marginals::~Marginals() = default;
Marginals::Marginals(Marginals&&) noexcept = default;
Marginals& Marginals::operator=(Marginals&&) noexcept = default;

bool Marginals::contains(base::VariableId id) const {
  return state_->find(id).has_value();
}

Eigen::MatrixXd Marginals::covariance(base::VariableId id) const {
  return jointCovariance({id});
}

Eigen::MatrixXd Marginals::jointCovariance(const std::vector<base::VariableId>& ids) const {
  std::vector<State::Place> places;
  std::vector<int> offsets = {0};
  for (const base::VariableId id : ids) {
    places.push_back(state_->at(id));
    offsets.push_back(offsets.back() + places.back().in_source.size);
  }
  Eigen::MatrixXd joint = Eigen::MatrixXd::Zero(offsets.back(), offsets.back());
  const std::lock_guard lock(state_->mutex);
  state_->forgetIfMany();
  for (std::size_t i = 0; i < ids.size(); ++i)
    for (std::size_t j = 0; j <= i; ++j) {
      if (places[i].is_fixed || places[j].is_fixed) continue;
      const bool in_order = places[i].in_source.number >= places[j].in_source.number;
      const std::size_t later = in_order ? i : j, earlier = in_order ? j : i;
      const Eigen::MatrixXd& part = state_->block(places[later].in_source, places[earlier].in_source);
      joint.block(offsets[later], offsets[earlier], part.rows(), part.cols()) = part;
      joint.block(offsets[earlier], offsets[later], part.cols(), part.rows()) = part.transpose();
    }
  return joint;
}

std::vector<Eigen::MatrixXd> Marginals::crossCovariances(base::VariableId id,
                                                         const std::vector<base::VariableId>& others) const {
  const State::Place place = state_->at(id);
  std::vector<Eigen::MatrixXd> blocks;
  std::vector<MarginalSource::Place> in_source;
  std::vector<std::size_t> indices;
  for (const base::VariableId other : others) {
    const State::Place at = state_->at(other);
    blocks.emplace_back(Eigen::MatrixXd::Zero(at.in_source.size, place.in_source.size));
    if (at.is_fixed || place.is_fixed) continue;
    in_source.push_back(at.in_source);
    indices.push_back(blocks.size() - 1);
  }
  if (in_source.empty()) return blocks;
  const std::lock_guard lock(state_->mutex);
  auto found = state_->column(place.in_source, in_source);
  for (std::size_t i = 0; i < indices.size(); ++i) blocks[indices[i]] = std::move(found[i]);
  return blocks;
}

}  // namespace omnimapper::graph
