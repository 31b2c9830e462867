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

/// An atomic list of edits of graph, landmarks and layers, with the decisions behind them. The engine applies it whole
/// or not at all. Ids of what a batch adds are provisional (isProvisional()): they can be used within this batch, and
/// final ids replace them when the batch is applied.
class Batch {
 public:
  /// A fixed variable keeps its value.
  base::VariableId addVariable(std::shared_ptr<const graph::Variable> kind, const Eigen::VectorXd& value,
                               bool fixed = false);
  void addFactor(graph::FactorRecord record) { added_factors_.push_back(std::move(record)); }
  /// A factor that would distort the map if it were wrong. It has no weight until the consistency test accepts it, and
  /// the result of the test completes `decision`. Throws Error(internal) if the factor has no outlierVolume(), without
  /// which the test cannot tell how easily a wrong one fits by chance.
  void addHypothesis(graph::FactorRecord record, Decision decision);
  /// The same for a factor without an outlierVolume(): the plugin itself has made sure that a wrong one hardly fits by
  /// chance, and the test applies its gate alone.
  void addGatedHypothesis(graph::FactorRecord record, Decision decision);
  void removeFactor(base::FactorId id) { removed_factors_.push_back(id); }
  /// Every factor that binds the variable must have been removed before or in this batch.
  void removeVariable(base::VariableId id) { removed_variables_.push_back(id); }
  void setWeight(base::FactorId id, double weight) { weights_.emplace_back(id, weight); }
  /// A better estimate of where the newest session lies in the map; allowed only while nothing ties it to the map.
  void placeSession(const SessionPlace& place) { session_place_ = place; }
  void log(Decision decision) { decisions_.push_back(std::move(decision)); }

  /// Adds a landmark; the measurement that it is made from is its first evidence. `measured_at` is the time of that
  /// measurement, or none for the stamp of the batch's key frame.
  base::LandmarkId addLandmark(const std::string& kind, std::vector<base::VariableId> variables,
                               std::shared_ptr<const map::LandmarkPayload> payload = nullptr,
                               std::optional<base::Stamp> measured_at = std::nullopt);
  /// Counts one more measurement of a landmark, made at time `measured_at`. If `payload` is not null, it replaces the
  /// landmark's payload.
  void addEvidence(base::LandmarkId id, std::shared_ptr<const map::LandmarkPayload> payload = nullptr,
                   std::optional<base::Stamp> measured_at = std::nullopt);
  /// Replaces the payload of a landmark without counting a measurement.
  void describeLandmark(base::LandmarkId id, std::shared_ptr<const map::LandmarkPayload> payload);
  /// Marks the landmark as no longer there: nothing is associated with it any more.
  void retireLandmark(base::LandmarkId id) { retired_landmarks_.push_back(id); }
  /// Merges two landmarks that are the same object: factors and evidence of `from` move to `into`, variable by
  /// variable, and the variables of `from` are removed. If `payload` is not null, it replaces that of `into`. A batch
  /// may merge several landmarks into one landmark, but not into a landmark that it merges into another one.
  void mergeLandmarks(base::LandmarkId from, base::LandmarkId into,
                      std::shared_ptr<const map::LandmarkPayload> payload = nullptr) {
    merges_.push_back({from, into, std::move(payload)});
  }

  /// Adds the layer of the map or replaces that of the same name (map/Layers.h). A layer may not refer to what this
  /// batch adds or removes: provisional ids are not replaced in it.
  template <class T>
  void setLayer(T value, const std::string& name = T::kLayer) {
    setLayer(name, std::make_shared<const map::LayerOf<T>>(std::move(value)));
  }
  /// The same with a layer of any class; null is not allowed.
  void setLayer(const std::string& name, std::shared_ptr<const map::Layer> layer) {
    layers_.emplace_back(name, std::move(layer));
  }
  void removeLayer(const std::string& name) { layers_.emplace_back(name, nullptr); }

  struct NewVariable {
    std::shared_ptr<const graph::Variable> kind;
    Eigen::VectorXd value;
    bool fixed;
  };
  struct NewLandmark {
    std::string kind;
    std::vector<base::VariableId> variables;
    std::shared_ptr<const map::LandmarkPayload> payload;
    std::optional<base::Stamp> measured_at;
  };
  struct Evidence {
    base::LandmarkId landmark;
    std::shared_ptr<const map::LandmarkPayload> payload;
    std::optional<base::Stamp> measured_at;
    bool is_measurement = true;
  };
  struct Merge {
    base::LandmarkId from, into;
    std::shared_ptr<const map::LandmarkPayload> payload;
  };
  /// Whether the batch has no edit and no decision.
  bool empty() const;
  /// Whether it changes the graph: decisions, layers, evidence, new and retired landmarks alone do not.
  bool changesGraph() const;
  /// Whether it adds, describes, retires or merges landmarks.
  bool changesLandmarks() const;
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
  /// By name; null for a layer that is removed.
  const std::vector<std::pair<std::string, std::shared_ptr<const map::Layer>>>& layers() const { return layers_; }
  /// If Decision::hypothesis is set, it is a provisional id whose index is the factor's position in addedFactors().
  const std::vector<Decision>& decisions() const { return decisions_; }

  /// Provisional ids have this session number, which no map uses.
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
  std::vector<std::pair<std::string, std::shared_ptr<const map::Layer>>> layers_;
};

/// The final ids of what an applied batch added, in the order of addition.
struct AppliedBatch {
  std::vector<base::VariableId> variables;
  std::vector<base::FactorId> factors;
  std::vector<base::LandmarkId> landmarks;
};

/// Which plugin made a batch, and when; both are written into its new landmarks.
struct BatchOrigin {
  std::string owner;  ///< INI section of the plugin
  base::Stamp stamp;  ///< of the key frame at which the batch was made
};

/// Why `batch` cannot be applied to this graph and map; empty if it can. A batch that a job made from an older state
/// may refer to something that has been removed since.
std::string whyUnfit(const Batch& batch, const graph::Graph& graph, const map::Map& map);

/// Applies all edits of `batch`. If one cannot be applied, it throws Error(internal) that names this edit, and graph
/// and map are unchanged. The ids of new landmarks contain the graph's session.
AppliedBatch apply(const Batch& batch, const BatchOrigin& origin, graph::Graph& graph, map::Map& map);

}  // namespace omnimapper::mapper
