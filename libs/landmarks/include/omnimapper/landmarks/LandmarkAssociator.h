#pragma once

#include <omnimapper/graph/FactorRecord.h>
#include <omnimapper/plugin/Association.h>
#include <omnimapper/plugin/Batch.h>
#include <omnimapper/plugin/View.h>

#include <Eigen/Core>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace omnimapper::landmarks {

/// A landmark that a measurement creates.
struct NewLandmark {
  std::string kind;  ///< map::Landmark::kind
  std::shared_ptr<const graph::Variable> variable;
  Eigen::VectorXd value;  ///< of the variable
  std::shared_ptr<const map::LandmarkPayload> payload;
};
/// A landmark and its variable; provisional ids if a batch adds them.
struct LandmarkIds {
  base::LandmarkId landmark;
  base::VariableId variable;
};

/// Turns the measurements of one observation into edits of map and graph (thesis 4.2.2.2). A measurement that passes
/// the gate of a known landmark, jointly with the others (mapper::associate()), becomes a factor on the landmark and
/// evidence for it; one that fits no landmark becomes a new one, unless the map is held; one that fits several is left
/// out. Where the relative pose of two sessions is unknown, a match is a hypothesis. Each measurement has a decision.
///
/// A type of landmarks derives from this class and says what its measurements mean. An object takes one observation.
template <class Measurement>
class LandmarkAssociator {
 public:
  virtual ~LandmarkAssociator() = default;
  LandmarkAssociator(const LandmarkAssociator&) = delete;
  LandmarkAssociator& operator=(const LandmarkAssociator&) = delete;

  /// To be called once.
  mapper::Batch take(const std::vector<Measurement>& measurements);

 protected:
  /// `section`: of the plugin, the owner of factors and decisions. All references must outlive this object.
  LandmarkAssociator(const mapper::AssociationOptions& options, const std::string& section, const map::KeyFrame& frame,
                     const mapper::View& view, mapper::Repeats repeats = mapper::Repeats::no)
      : options_(options), section_(section), frame_(frame), view_(view), repeats_(repeats) {}

  /// Sets the kind of the decision about a measurement, and the numbers that are known before it is associated.
  virtual void describe(const Measurement& measurement, mapper::Decision& decision) const = 0;
  /// Why a measurement cannot be used; empty if it can. Of a useless measurement no other function but describe() is
  /// asked.
  virtual std::string whyUseless(const Measurement& /*measurement*/) const { return {}; }
  /// Whether the sensor tells which landmark it measured, for example by a number: candidates() then has this landmark
  /// alone, or none. If the measurement does not pass its gate, it is kept with weight 0, so that the search for moved
  /// landmarks finds it. Landmarks that were met in this way are no candidates of other measurements.
  virtual bool isIdentified(const Measurement& /*measurement*/) const { return false; }
  /// The landmarks that a measurement may be of: a coarse preselection, before the gate.
  virtual std::vector<base::LandmarkId> candidates(const Measurement& measurement) = 0;
  /// The factor of a measurement of the landmark with this variable; owner and landmark need not be set.
  virtual graph::FactorRecord record(const Measurement& measurement, base::VariableId landmark) const = 0;
  /// The factor by which the gate of a known landmark is computed: another one than record() if that binds a variable
  /// that this batch adds, whose covariance is unknown.
  virtual graph::FactorRecord gateRecord(const Measurement& measurement, base::VariableId landmark) const {
    return record(measurement, landmark);
  }
  /// Why a measurement that fits two landmarks about equally well may be given to either; empty if it may not.
  virtual std::string whyEither(base::LandmarkId /*a*/, base::LandmarkId /*b*/) const { return {}; }
  /// The payload of a landmark after a further measurement, or null to keep the payload (payloadOf()). Called after the
  /// factor of the measurement was added; may add further edits to batch().
  virtual std::shared_ptr<const map::LandmarkPayload> learned(const Measurement& measurement,
                                                              const LandmarkIds& known) = 0;
  /// Adds the landmark of a measurement that fits none (addLandmark()), or logs the decision with the reason why not.
  /// Never called if the map is held. `decision` says why no landmark matches.
  virtual void addNew(const Measurement& measurement, mapper::Decision decision) = 0;

  /// The payload of a landmark, with what this observation has added to it so far.
  template <class Payload>
  const Payload& payloadOf(base::LandmarkId landmark) const {
    const auto found = payloads_.find(landmark);
    return dynamic_cast<const Payload&>(found != payloads_.end() ? *found->second
                                                                 : *view_.map.landmark(landmark).payload);
  }
  void addFactor(const Measurement& measurement, const LandmarkIds& of) { batch_.addFactor(tagged(measurement, of)); }
  /// Counts one more measurement of a landmark; null keeps the payload.
  void addEvidence(base::LandmarkId landmark, std::shared_ptr<const map::LandmarkPayload> payload);
  /// Logs the decision as accepted, and adds a landmark with the factor of its first measurement.
  LandmarkIds addLandmark(const Measurement& measurement, mapper::Decision decision, NewLandmark fresh);
  mapper::Decision decisionOf(const Measurement& measurement) const;

  const map::KeyFrame& frame() const { return frame_; }
  const mapper::View& view() const { return view_; }
  const std::string& section() const { return section_; }
  mapper::Batch& batch() { return batch_; }
  /// The known landmarks that measurements were matched with or identified as.
  const std::set<base::LandmarkId>& met() const { return met_; }

 private:
  using Method = mapper::AssociationOptions::Method;

  void takeTogether(const std::vector<const Measurement*>& measurements, Method method);
  std::vector<mapper::Pairing> pairingsOf(const std::vector<const Measurement*>& measurements);
  void settle(const Measurement& measurement, const mapper::Match& match, std::optional<LandmarkIds> nearest,
              mapper::Decision decision);
  void addToKnown(const Measurement& measurement, const LandmarkIds& known, mapper::Decision decision);
  void keepWithoutWeight(const Measurement& measurement, const LandmarkIds& known, mapper::Decision decision);
  // Whether a measurement of this landmark would be the first to tie its session to that of the key frame: if it were
  // wrong, it would displace the whole session.
  bool tiesSessions(const LandmarkIds& known) const {
    return !view_.areAligned(frame_.id.session, known.landmark.session);
  }
  void propose(const Measurement& measurement, const LandmarkIds& known, mapper::Decision decision);
  graph::FactorRecord tagged(const Measurement& measurement, const LandmarkIds& of) const;
  LandmarkIds idsOf(base::LandmarkId known) const { return {known, view_.map.landmark(known).variables.front()}; }

  const mapper::AssociationOptions& options_;
  const std::string& section_;
  const map::KeyFrame& frame_;
  const mapper::View& view_;
  const mapper::Repeats repeats_;
  std::set<base::LandmarkId> met_;
  std::map<base::LandmarkId, std::shared_ptr<const map::LandmarkPayload>> payloads_;  // those of this batch
  mapper::Batch batch_;
};

template <class Measurement>
mapper::Batch LandmarkAssociator<Measurement>::take(const std::vector<Measurement>& measurements) {
  std::vector<const Measurement*> identified, others;
  for (const auto& measurement : measurements) {
    const std::string why = whyUseless(measurement);
    if (why.empty()) {
      (isIdentified(measurement) ? identified : others).push_back(&measurement);
    } else {
      mapper::Decision decision = decisionOf(measurement);
      decision.reason = why;
      batch_.log(std::move(decision));
    }
  }
  takeTogether(identified, Method::nearest);  // each has one candidate, so there is nothing to decide jointly
  takeTogether(others, options_.method);
  return std::move(batch_);
}

template <class Measurement>
void LandmarkAssociator<Measurement>::takeTogether(const std::vector<const Measurement*>& measurements, Method method) {
  if (measurements.empty()) return;
  const auto pairings = pairingsOf(measurements);
  mapper::AssociationOptions options = options_;
  options.method = method;
  const auto found = mapper::associate(measurements.size(), pairings, view_, options, repeats_);
  // Known before the first is settled, so that addNew() does not give up what another measurement of the image shows.
  for (const auto& match : found.matches)
    if (match.kind == mapper::Match::Kind::matched) met_.insert(pairings[*match.pairing].landmark);
  for (std::size_t i = 0; i < measurements.size(); ++i) {
    const auto& match = found.matches[i];
    std::optional<LandmarkIds> nearest;
    if (match.pairing) nearest = idsOf(pairings[*match.pairing].landmark);
    mapper::Decision decision = decisionOf(*measurements[i]);
    found.describe(i, decision);
    if (nearest) decision.numbers.emplace_back("landmark", nearest->landmark.index);
    settle(*measurements[i], match, nearest, std::move(decision));
  }
}

template <class Measurement>
std::vector<mapper::Pairing> LandmarkAssociator<Measurement>::pairingsOf(
    const std::vector<const Measurement*>& measurements) {
  std::vector<mapper::Pairing> pairings;
  for (std::size_t i = 0; i < measurements.size(); ++i) {
    for (const auto id : candidates(*measurements[i]))
      if (met_.count(id) == 0) pairings.push_back({i, id, gateRecord(*measurements[i], idsOf(id).variable)});
  }
  return pairings;
}

template <class Measurement>
void LandmarkAssociator<Measurement>::settle(const Measurement& measurement, const mapper::Match& match,
                                             std::optional<LandmarkIds> nearest, mapper::Decision decision) {
  using Kind = mapper::Match::Kind;
  const std::string either = match.kind == Kind::ambiguous ? whyEither(nearest->landmark, *match.rival) : "";
  if (!either.empty()) {
    decision.accepted = true;
    decision.reason = "matched: " + either;
  }
  if (match.kind == Kind::matched || !either.empty()) {
    addToKnown(measurement, *nearest, std::move(decision));
  } else if (nearest && isIdentified(measurement)) {
    keepWithoutWeight(measurement, *nearest, std::move(decision));
  } else if (match.kind != Kind::unknown) {
    batch_.log(std::move(decision));
  } else if (view_.map_is_held) {
    decision.reason = "not in the map: " + decision.reason;
    batch_.log(std::move(decision));
  } else {
    addNew(measurement, std::move(decision));
  }
}

template <class Measurement>
void LandmarkAssociator<Measurement>::addToKnown(const Measurement& measurement, const LandmarkIds& known,
                                                 mapper::Decision decision) {
  met_.insert(known.landmark);
  if (tiesSessions(known)) return propose(measurement, known, std::move(decision));
  batch_.log(std::move(decision));
  addFactor(measurement, known);
  addEvidence(known.landmark, learned(measurement, known));
}

template <class Measurement>
void LandmarkAssociator<Measurement>::addEvidence(base::LandmarkId landmark,
                                                  std::shared_ptr<const map::LandmarkPayload> payload) {
  if (payload) payloads_[landmark] = payload;
  batch_.addEvidence(landmark, std::move(payload));
}

template <class Measurement>
void LandmarkAssociator<Measurement>::keepWithoutWeight(const Measurement& measurement, const LandmarkIds& known,
                                                        mapper::Decision decision) {
  met_.insert(known.landmark);
  if (tiesSessions(known)) return propose(measurement, known, std::move(decision));
  decision.reason = "gated out: not where its landmark is; kept without weight";
  batch_.log(std::move(decision));
  graph::FactorRecord elsewhere = tagged(measurement, known);
  elsewhere.weight = 0;
  batch_.addFactor(std::move(elsewhere));
}

template <class Measurement>
void LandmarkAssociator<Measurement>::propose(const Measurement& measurement, const LandmarkIds& known,
                                              mapper::Decision decision) {
  decision.accepted = false;
  decision.reason = "waits for the consistency test";
  batch_.addGatedHypothesis(tagged(measurement, known), std::move(decision));
}

template <class Measurement>
LandmarkIds LandmarkAssociator<Measurement>::addLandmark(const Measurement& measurement, mapper::Decision decision,
                                                         NewLandmark fresh) {
  decision.accepted = true;
  decision.reason = "new: " + decision.reason;
  batch_.log(std::move(decision));
  LandmarkIds ids;
  ids.variable = batch_.addVariable(std::move(fresh.variable), fresh.value);
  ids.landmark = batch_.addLandmark(fresh.kind, {ids.variable}, fresh.payload);
  payloads_[ids.landmark] = std::move(fresh.payload);
  addFactor(measurement, ids);
  return ids;
}

template <class Measurement>
graph::FactorRecord LandmarkAssociator<Measurement>::tagged(const Measurement& measurement,
                                                            const LandmarkIds& of) const {
  graph::FactorRecord record = this->record(measurement, of.variable);
  record.tags.owner = section_;
  record.tags.landmark = of.landmark;
  return record;
}

template <class Measurement>
mapper::Decision LandmarkAssociator<Measurement>::decisionOf(const Measurement& measurement) const {
  mapper::Decision decision;
  decision.stamp = frame_.stamp;
  decision.plugin = section_;
  decision.from = frame_.id;
  describe(measurement, decision);
  return decision;
}

}  // namespace omnimapper::landmarks
