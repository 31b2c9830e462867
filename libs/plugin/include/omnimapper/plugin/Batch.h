#pragma once

#include <omnimapper/graph/Graph.h>
#include <omnimapper/map/Map.h>
#include <omnimapper/plugin/DecisionLog.h>
#include <omnimapper/plugin/SessionStart.h>

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace omnimapper::mapper {

/// An atomic list of edits of graph and landmarks, with the decisions behind them. The engine applies it whole or not
/// at all. Ids of what it adds are provisional (see isProvisional): usable within this batch, replaced on applying.
class Batch {
 public:
  /// A fixed variable keeps its value.
  base::VariableId addVariable(std::shared_ptr<const graph::Variable> kind, const Eigen::VectorXd& value,
                               bool fixed = false);
  void addFactor(graph::FactorRecord record) { added_factors_.push_back(std::move(record)); }
  /// A factor that could be wrong in a way that bends the map: it acts once the consistency test has accepted it, and
  /// the verdict completes `decision`.
  void addHypothesis(graph::FactorRecord record, Decision decision);
  void removeFactor(base::FactorId id) { removed_factors_.push_back(id); }
  /// Once nothing binds it any more.
  void removeVariable(base::VariableId id) { removed_variables_.push_back(id); }
  void setWeight(base::FactorId id, double weight) { weights_.emplace_back(id, weight); }
  /// A better guess of where the newest session lies in the map, as long as nothing ties it to that.
  void placeSession(const SessionPlace& place) { session_place_ = place; }
  void log(Decision decision) { decisions_.push_back(std::move(decision)); }

  /// A new landmark; the measurement that made it is its first evidence. `seen`: when that was; none: at the key frame
  /// of the batch.
  base::LandmarkId addLandmark(const std::string& kind, std::vector<base::VariableId> variables,
                               std::shared_ptr<const map::LandmarkPayload> payload = nullptr,
                               std::optional<base::Stamp> seen = std::nullopt);
  /// One more observation of it, `seen` then. A payload replaces the one it has; null keeps that.
  void addEvidence(base::LandmarkId id, std::shared_ptr<const map::LandmarkPayload> payload = nullptr,
                   std::optional<base::Stamp> seen = std::nullopt);
  /// What is known of it has changed without a sighting.
  void describeLandmark(base::LandmarkId id, std::shared_ptr<const map::LandmarkPayload> payload);
  /// It is no longer there: nothing is to be associated with it any more.
  void retireLandmark(base::LandmarkId id) { retired_landmarks_.push_back(id); }
  /// Both are one thing: `from` gives its factors and evidence to `into`, variable by variable, and its variables go.
  /// A payload replaces the one of `into`; null keeps that. One may take in several; one that goes takes in none.
  void mergeLandmarks(base::LandmarkId from, base::LandmarkId into,
                      std::shared_ptr<const map::LandmarkPayload> payload = nullptr) {
    merges_.push_back({from, into, std::move(payload)});
  }

  struct NewVariable {
    std::shared_ptr<const graph::Variable> kind;
    Eigen::VectorXd value;
    bool fixed;
  };
  struct NewLandmark {
    std::string kind;
    std::vector<base::VariableId> variables;
    std::shared_ptr<const map::LandmarkPayload> payload;
    std::optional<base::Stamp> seen;
  };
  struct Evidence {
    base::LandmarkId landmark;
    std::shared_ptr<const map::LandmarkPayload> payload;
    std::optional<base::Stamp> seen;
    bool is_sighting = true;
  };
  struct Merge {
    base::LandmarkId from, into;
    std::shared_ptr<const map::LandmarkPayload> payload;
  };
  /// No edit and no decision.
  bool empty() const;
  /// Whether it is more than decisions, evidence and retired landmarks.
  bool changesGraph() const;
  const std::vector<NewVariable>& addedVariables() const { return added_variables_; }
  const std::vector<graph::FactorRecord>& addedFactors() const { return added_factors_; }
  const std::vector<NewLandmark>& addedLandmarks() const { return added_landmarks_; }
  const std::vector<base::FactorId>& removedFactors() const { return removed_factors_; }
  const std::vector<base::VariableId>& removedVariables() const { return removed_variables_; }
  const std::vector<std::pair<base::FactorId, double>>& weights() const { return weights_; }
  const std::vector<Evidence>& evidence() const { return evidence_; }
  const std::vector<base::LandmarkId>& retiredLandmarks() const { return retired_landmarks_; }
  const std::vector<Merge>& merges() const { return merges_; }
  const std::optional<SessionPlace>& sessionPlace() const { return session_place_; }
  /// A decision's `hypothesis`, where it has one, is the number of the factor in addedFactors().
  const std::vector<Decision>& decisions() const { return decisions_; }

  /// Provisional ids carry a session that no map has.
  static constexpr std::uint16_t kProvisionalSession = 0xFFFF;
  template <class Tag>
  static bool isProvisional(base::Id<Tag> id) {
    return id.session == kProvisionalSession;
  }

 private:
  std::vector<NewVariable> added_variables_;
  std::vector<graph::FactorRecord> added_factors_;
  std::vector<NewLandmark> added_landmarks_;
  std::vector<base::FactorId> removed_factors_;
  std::vector<base::VariableId> removed_variables_;
  std::vector<std::pair<base::FactorId, double>> weights_;
  std::vector<Evidence> evidence_;
  std::vector<base::LandmarkId> retired_landmarks_;
  std::vector<Merge> merges_;
  std::vector<Decision> decisions_;
  std::optional<SessionPlace> session_place_;
};

/// What applying a batch gave: final ids in the order they were added.
struct AppliedBatch {
  std::vector<base::VariableId> variables;
  std::vector<base::FactorId> factors;
  std::vector<base::LandmarkId> landmarks;
};

/// Who made a batch, and when: written into its landmarks.
struct BatchOrigin {
  std::string owner;  ///< INI section of the plugin
  base::Stamp stamp;  ///< of the key frame it was made at
};

/// Why `batch` cannot be applied as things are; empty if it can. A batch that a job made of an older state may speak of
/// what is gone since.
std::string whyUnfit(const Batch& batch, const graph::Graph& graph, const map::Map& map);

/// Applies all edits of `batch`, or throws Error(internal) naming the edit that does not fit and leaves graph and map
/// as they were. New landmarks carry the graph's session.
AppliedBatch apply(const Batch& batch, const BatchOrigin& origin, graph::Graph& graph, map::Map& map);

}  // namespace omnimapper::mapper
