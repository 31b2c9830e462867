#include <omnimapper/base/Error.h>
#include <omnimapper/plugin/Batch.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace omnimapper::mapper {

namespace {

template <class Id>
Id finalId(Id id, const std::vector<Id>& final_ids) {
  return Batch::isProvisional(id) ? final_ids.at(id.index) : id;
}

// Checks that the ids in the batch exist, in the graph and the map or among its own additions, and that its edits fit.
class Check {
 public:
  Check(const Batch& batch, const graph::Graph& graph, const map::Map& map) : batch_(batch), graph_(graph), map_(map) {}

  std::string whyUnfit() {
    collectWhatLayersNeed();
    for (const auto id : batch_.removedFactors()) checkRemoved(id);
    for (const auto& [id, weight] : batch_.weights()) {
      need(graph_.contains(id), "weight of factor " + toString(id), "the graph has no such factor");
      need(weight >= 0 && std::isfinite(weight), "weight of factor " + toString(id), "is negative or not finite");
      need(!graph_.contains(id) || !graph_.factor(id).tags.hypothesis, "weight of factor " + toString(id),
           "is a hypothesis, whose weight the consistency test sets");
    }
    for (const auto& record : batch_.addedFactors()) {
      for (const auto id : record.variables) needVariable(id, "added factor");
      if (record.tags.landmark) needLandmark(*record.tags.landmark, "added factor");
    }
    for (const auto& landmark : batch_.addedLandmarks()) {
      for (const auto id : landmark.variables) needVariable(id, "added landmark");
    }
    for (const auto& evidence : batch_.evidence()) needLandmark(evidence.landmark, "evidence");
    for (const auto id : batch_.retiredLandmarks()) needLandmark(id, "retired landmark");
    for (const auto& merge : batch_.merges()) checkMerge(merge.from, merge.into);
    for (const auto id : batch_.removedVariables()) checkRemoved(id);
    if (const auto& place = batch_.sessionPlace()) {
      const std::string why = whyFixed(*place, graph_, map_);
      need(why.empty(), "place of a session", why);
    }
    for (const auto& [name, layer] : batch_.layers()) checkLayer(name, layer.get());
    return problem_;
  }

 private:
  void need(bool holds, const std::string& edit, const std::string& why) {
    if (!holds && problem_.empty()) problem_ = edit + ": " + why;
  }
  void needVariable(base::VariableId id, const std::string& edit) {
    if (Batch::isProvisional(id)) {
      need(id.index < batch_.addedVariables().size(), edit, "binds a provisional variable that the batch does not add");
    } else {
      need(graph_.contains(id), edit, "the graph has no variable " + toString(id));
    }
  }
  void needLandmark(base::LandmarkId id, const std::string& edit) {
    if (Batch::isProvisional(id)) {
      need(id.index < batch_.addedLandmarks().size(), edit,
           "refers to a provisional landmark that the batch does not add");
    } else {
      const map::Landmark* landmark = map_.landmarks.find(id);
      need(landmark != nullptr, edit, "the map has no landmark " + toString(id));
      if (landmark) {
        need(landmark->state != map::Landmark::State::merged, edit, "landmark " + toString(id) + " was merged");
      }
    }
  }
  // The variables that the layers of the map refer to when the batch has been applied.
  void collectWhatLayersNeed() {
    const auto collect = [&](const std::string& name, const map::Layer& layer) {
      for (const auto id : layer.references().variables) needed_by_.emplace(id, name);
    };
    for (const auto& [name, layer] : map_.layers) {
      const auto is_set = [&name = name](const auto& other) { return other.first == name; };
      if (std::none_of(batch_.layers().begin(), batch_.layers().end(), is_set)) collect(name, *layer);
    }
    for (const auto& [name, layer] : batch_.layers())
      if (layer) collect(name, *layer);
  }
  void checkNoLayerNeeds(base::VariableId id, const std::string& edit) {
    const auto layer = needed_by_.find(id);
    if (layer != needed_by_.end()) need(false, edit, "the layer \"" + layer->second + "\" refers to " + toString(id));
  }
  void checkLayer(const std::string& name, const map::Layer* layer) {
    const std::string edit = "layer \"" + name + "\"";
    need(map::isLayerName(name), edit, "a layer cannot have this name");
    if (!layer) return;
    const auto references = layer->references();
    for (const auto id : references.variables) need(graph_.contains(id), edit, "the graph has no " + toString(id));
    for (const auto id : references.landmarks)
      need(map_.landmarks.find(id) != nullptr, edit, "the map has no landmark " + toString(id));
    for (const auto id : references.key_frames)
      need(map_.key_frames.find(id) != nullptr, edit, "the map has no key frame " + toString(id));
  }
  void checkRemoved(base::FactorId id) {
    const std::string edit = "removed factor " + toString(id);
    need(graph_.contains(id), edit, "the graph has no such factor");
    need(removed_.insert(id).second, edit, "is removed twice");
  }
  // Every factor that binds the variable must be removed too.
  void checkRemoved(base::VariableId id) {
    const std::string edit = "removed variable " + toString(id);
    need(graph_.contains(id), edit, "the graph has no such variable");
    if (!graph_.contains(id)) return;
    for (const auto factor : graph_.factorsOf(id)) {
      need(removed_.count(factor) > 0, edit, "is still bound by factor " + toString(factor));
    }
    for (const auto& record : batch_.addedFactors()) {
      const bool bound = std::count(record.variables.begin(), record.variables.end(), id) > 0;
      need(!bound, edit, "is bound by a factor that the batch adds");
    }
    need(removed_variables_.insert(id).second, edit, "is removed twice");
    for (const auto& [landmark_id, landmark] : map_.landmarks) {
      const bool held = std::count(landmark.variables.begin(), landmark.variables.end(), id) > 0;
      need(!held, edit, "belongs to landmark " + toString(landmark_id));
    }
    checkNoLayerNeeds(id, edit);
  }
  void checkMerge(base::LandmarkId from, base::LandmarkId into) {
    const std::string edit = "merge of landmark " + toString(from) + " into " + toString(into);
    need(from != into, edit, "they are the same");
    kept_.insert(into);
    need(gone_.insert(from).second, edit, "it is merged twice in a batch");
    need(gone_.count(into) == 0 && kept_.count(from) == 0, edit,
         "a landmark that is merged away cannot have others merged into it");
    need(!Batch::isProvisional(from) && !Batch::isProvisional(into), edit, "only landmarks of the map can be merged");
    needLandmark(from, edit);
    needLandmark(into, edit);
    if (!problem_.empty()) return;
    for (const auto id : map_.landmarks.find(from)->variables) checkNoLayerNeeds(id, edit);
    const auto &a = map_.landmarks.find(from)->variables, &b = map_.landmarks.find(into)->variables;
    const bool alike = a.size() == b.size() && std::equal(a.begin(), a.end(), b.begin(), [&](auto x, auto y) {
                         return graph_.variable(x).kind->kind() == graph_.variable(y).kind->kind();
                       });
    need(alike, edit, "their variables are of different kinds");
    for (const auto& evidence : batch_.evidence())
      need(evidence.landmark != from, edit, "the batch adds evidence to the landmark that is merged away");
    for (const auto& record : batch_.addedFactors()) {
      for (const auto id : record.variables) {
        need(std::count(a.begin(), a.end(), id) == 0, edit,
             "the batch adds a factor to the landmark that is merged away");
      }
    }
  }

  const Batch& batch_;
  const graph::Graph& graph_;
  const map::Map& map_;
  std::map<base::VariableId, std::string> needed_by_;  // the name of a layer
  std::set<base::FactorId> removed_;
  std::set<base::VariableId> removed_variables_;
  std::set<base::LandmarkId> gone_, kept_;
  std::string problem_;
};

// A factor that binds both landmarks is removed: it would bind the same variable twice, and has no information any
// more.
void merge(base::LandmarkId from, base::LandmarkId into, graph::Graph& graph, map::Map& map) {
  map::Landmark& gone = *map.landmarks.edit(from);
  map::Landmark& kept = *map.landmarks.edit(into);
  for (std::size_t i = 0; i < gone.variables.size(); ++i) {
    const std::vector<base::FactorId> factors = graph.factorsOf(gone.variables[i]);
    for (const auto id : factors) {
      auto variables = graph.factor(id).variables;
      const bool binds_both = std::count(variables.begin(), variables.end(), kept.variables[i]) > 0;
      if (binds_both) {
        graph.removeFactor(id);
      } else {
        std::replace(variables.begin(), variables.end(), gone.variables[i], kept.variables[i]);
        graph.rebind(id, variables);
        graph.setLandmark(id, into);
      }
    }
    graph.removeVariable(gone.variables[i]);
  }
  gone.variables.clear();
  gone.state = map::Landmark::State::merged;
  gone.merged_into = into;
  kept.evidence += gone.evidence;
  kept.first_seen = std::min(kept.first_seen, gone.first_seen);
  kept.last_seen = std::max(kept.last_seen, gone.last_seen);
}

// The graph can still refuse a value or a kind; then everything that was added is removed again.
void addToGraph(const Batch& batch, const BatchOrigin& origin, graph::Graph& graph, map::Map& map,
                AppliedBatch& applied) {
  try {
    for (const auto& variable : batch.addedVariables()) {
      applied.variables.push_back(graph.addVariable(variable.kind, variable.value, variable.fixed));
    }
    for (std::size_t i = 0; i < batch.addedLandmarks().size(); ++i) {
      const auto first = map.landmarks.nextId(graph.session());
      applied.landmarks.push_back({first.session, first.index + static_cast<std::uint32_t>(i)});
    }
    for (graph::FactorRecord record : batch.addedFactors()) {
      for (auto& id : record.variables) id = finalId(id, applied.variables);
      if (record.tags.landmark) record.tags.landmark = finalId(*record.tags.landmark, applied.landmarks);
      applied.factors.push_back(graph.addFactor(std::move(record)));
    }
  } catch (const base::Error& error) {
    for (const auto id : applied.factors) graph.removeFactor(id);
    for (const auto id : applied.variables) graph.removeVariable(id);
    throw base::Error(base::ExitCode::internal,
                      "batch of [" + origin.owner + "]: " + error.what() + "; the graph is unchanged");
  }
}

}  // namespace

bool Batch::empty() const {
  return added_variables_.empty() && added_factors_.empty() && added_landmarks_.empty() && removed_factors_.empty() &&
         removed_variables_.empty() && weights_.empty() && evidence_.empty() && retired_landmarks_.empty() &&
         merges_.empty() && decisions_.empty() && layers_.empty() && !session_place_;
}

bool Batch::changesLandmarks() const {
  return !(added_landmarks_.empty() && evidence_.empty() && retired_landmarks_.empty() && merges_.empty());
}

bool Batch::changesGraph() const {
  return !(added_variables_.empty() && added_factors_.empty() && removed_factors_.empty() &&
           removed_variables_.empty() && weights_.empty() && merges_.empty() && !session_place_);
}

base::VariableId Batch::addVariable(std::shared_ptr<const graph::Variable> kind, const Eigen::VectorXd& value,
                                    bool fixed) {
  added_variables_.push_back({std::move(kind), value, fixed});
  return {kProvisionalSession, static_cast<std::uint32_t>(added_variables_.size() - 1)};
}

void Batch::addHypothesis(graph::FactorRecord record, Decision decision) {
  if (!record.factor->outlierVolume(Eigen::Vector3d::Ones())) {
    throw base::Error(
        base::ExitCode::internal,
        "the plugin '" + record.tags.owner + "' proposes a hypothesis of the kind '" +
            std::string(record.factor->kind()) +
            "', which does not say where a wrong measurement may lie: override Factor::outlierVolume(), or "
            "compare the likelihoods in the plugin and call addGatedHypothesis()");
  }
  addGatedHypothesis(std::move(record), std::move(decision));
}

void Batch::addGatedHypothesis(graph::FactorRecord record, Decision decision) {
  record.tags.hypothesis = true;
  decision.hypothesis = {kProvisionalSession, static_cast<std::uint32_t>(added_factors_.size())};
  added_factors_.push_back(std::move(record));
  decisions_.push_back(std::move(decision));
}

base::LandmarkId Batch::addLandmark(const std::string& kind, std::vector<base::VariableId> variables,
                                    std::shared_ptr<const map::LandmarkPayload> payload,
                                    std::optional<base::Stamp> measured_at) {
  added_landmarks_.push_back({kind, std::move(variables), std::move(payload), measured_at});
  return {kProvisionalSession, static_cast<std::uint32_t>(added_landmarks_.size() - 1)};
}

void Batch::addEvidence(base::LandmarkId id, std::shared_ptr<const map::LandmarkPayload> payload,
                        std::optional<base::Stamp> measured_at) {
  evidence_.push_back({id, std::move(payload), measured_at});
}

void Batch::describeLandmark(base::LandmarkId id, std::shared_ptr<const map::LandmarkPayload> payload) {
  evidence_.push_back({id, std::move(payload), std::nullopt, false});
}

std::string whyUnfit(const Batch& batch, const graph::Graph& graph, const map::Map& map) {
  return Check(batch, graph, map).whyUnfit();
}

AppliedBatch apply(const Batch& batch, const BatchOrigin& origin, graph::Graph& graph, map::Map& map) {
  const std::string problem = whyUnfit(batch, graph, map);
  if (!problem.empty()) {
    throw base::Error(base::ExitCode::internal,
                      "batch of [" + origin.owner + "]: " + problem + "; the graph is unchanged");
  }
  AppliedBatch applied;
  addToGraph(batch, origin, graph, map, applied);
  for (const auto& added : batch.addedLandmarks()) {
    map::Landmark landmark;
    landmark.id = map.landmarks.nextId(graph.session());
    landmark.kind = added.kind;
    landmark.owner = origin.owner;
    for (const auto id : added.variables) landmark.variables.push_back(finalId(id, applied.variables));
    landmark.payload = added.payload;
    landmark.evidence = 1;
    landmark.first_seen = landmark.last_seen = added.measured_at.value_or(origin.stamp);
    map.landmarks.add(graph.session(), std::move(landmark));
  }
  for (const auto& [id, weight] : batch.weights()) graph.setWeight(id, weight);
  for (const auto id : batch.removedFactors()) graph.removeFactor(id);
  for (const auto& evidence : batch.evidence()) {
    map::Landmark& landmark = *map.landmarks.edit(finalId(evidence.landmark, applied.landmarks));
    if (evidence.is_measurement) {
      ++landmark.evidence;
      const base::Stamp measured_at = evidence.measured_at.value_or(origin.stamp);
      landmark.first_seen = std::min(landmark.first_seen, measured_at);
      landmark.last_seen = std::max(landmark.last_seen, measured_at);
    }
    if (evidence.payload) landmark.payload = evidence.payload;
  }
  for (const auto id : batch.retiredLandmarks()) {
    map.landmarks.edit(finalId(id, applied.landmarks))->state = map::Landmark::State::retired;
  }
  for (const auto& [from, into, payload] : batch.merges()) {
    merge(from, into, graph, map);
    if (payload) map.landmarks.edit(into)->payload = payload;
  }
  for (const auto id : batch.removedVariables()) graph.removeVariable(id);
  if (batch.sessionPlace()) placeSession(*batch.sessionPlace(), graph, map);
  for (const auto& [name, layer] : batch.layers()) {
    if (layer) {
      map.layers.set(name, layer);
    } else {
      map.layers.remove(name);
    }
  }
  return applied;
}

}  // namespace omnimapper::mapper
