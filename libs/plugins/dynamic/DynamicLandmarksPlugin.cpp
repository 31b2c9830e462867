#include "DynamicLandmarksPlugin.h"

#include <omnimapper/base/Config.h>
#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/graph/ChiSquare.h>
#include <omnimapper/graph/Solver.h>
#include <omnimapper/plugin/PoseFactors.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>

#include "LandmarkRelocations.h"
#include "MovedThingPayload.h"
#include "WeakPrior.h"

namespace omnimapper::plugins {

const base::OptionTable<DynamicLandmarksOptions>& DynamicLandmarksOptions::table() {
  using Options = DynamicLandmarksOptions;
  using base::Range;
  static const auto table =
      base::OptionTable<Options>()
          .list("landmarks", &Options::landmarks,
                "INI sections of the plugins whose landmarks may have been moved; empty for all plugins.")
          .integer("every_solves", &Options::every_solves, Range::notNegative(),
                   "Number of solves after which moved landmarks are searched for, in addition to the end of the "
                   "log; 0 searches only at the end.")
          .number("max_weight", &Options::max_weight, Range{0, 1},
                  "Each landmark gets a weight between 0 and 1. It is 1 if all measurements fit one place, and 0 if "
                  "they fit none. A landmark with a smaller weight than this is examined for having moved. A landmark "
                  "that has not moved has a weight of 0.9 or more in 99 of 100 cases.")
          .integer("min_measurements", &Options::min_measurements, Range{1, 1e6},
                   "A landmark counts as having been at a place only if at least this many measurements put it there; "
                   "fewer are taken as errors.")
          .number("min_move_m", &Options::min_move, Range::notNegative(),
                  "A landmark counts as moved only if it was measured at places that are at least this far apart.")
          .number("visit_gap_s", &Options::visit_gap, Range::positive(),
                  "A landmark that was out of sight for longer than this may have been moved in the meantime.")
          .number("confidence", &Options::confidence, Range{0.5, 0.999999999},
                  "Probability with which measurements of a landmark that did not move are recognized as being of one "
                  "place.");
  return table;
}

namespace {

// One search for moved landmarks.
class MovedLandmarkSearch {
 public:
  MovedLandmarkSearch(const DynamicLandmarksOptions& options, const std::string& section, const mapper::View& view)
      : options_(options), section_(section), view_(view) {}

  mapper::Batch run() {
    const auto landmarks = landmarksToWeigh(view_, options_.landmarks);
    if (landmarks.empty()) return {};
    Weighing weighing = weighLandmarks(withWeakPriors(landmarks), landmarks);
    std::vector<WeighedLandmark> suspects;
    for (const auto& landmark : weighing.landmarks) {
      restoreWeights(landmark.measurements, weighing.graph);
      const bool has_place =
          middleOf(view_.map.landmark(landmark.id), valuesOf(landmark), view_.map.key_frames).has_value();
      if (landmark.weight < options_.max_weight && has_place) suspects.push_back(landmark);
    }
    if (!suspects.empty()) {
      for (const auto& landmark : suspects) setWeights(landmark.measurements, 0, weighing.graph);
      auto places = clusterMeasurements(view_.map, weighing.graph, suspects, options_);
      if (!places) return undetermined("a part of the map is unconstrained");
      for (std::size_t i = 0; i < suspects.size(); ++i) judge(suspects[i], std::move((*places)[i]), weighing.graph);
      graph::solve(weighing.graph, {graph::SolveOptions::Method::levenberg_marquardt, 50, 1e-7, {}});
      const MeasurementFrames frames(view_.map.key_frames);
      for (const auto& [landmark, seen] : moved_) addRecord(landmark, seen, frames, weighing.graph);
    }
    for (const auto& landmark : landmarks) {
      for (const auto id : landmark.measurements) {
        const double weight = weighing.graph.factor(id).weight;
        if (weight != view_.graph.factor(id).weight) batch_.setWeight(id, weight);
      }
    }
    if (!keepsSessionsDetermined())
      return undetermined("without the landmarks that seem to have moved, a part of the map is unconstrained");
    return std::move(batch_);
  }

 private:
  // A copy of the graph with weak priors, which keep landmarks and whole sessions in place if their measurements lose
  // all weight.
  graph::Graph withWeakPriors(const std::vector<WeighedLandmark>& landmarks) const {
    graph::Graph graph = view_.graph;
    for (const auto& landmark : landmarks)
      for (const auto id : landmark.variables) addWeakPrior(graph, id);
    std::set<std::uint16_t> sessions;
    for (const auto& frame : view_.map.key_frames)
      if (sessions.insert(frame.id.session).second && !graph.variable(frame.pose).fixed)
        addWeakPrior(graph, frame.pose);
    return graph;
  }

  // Whether the place of each session in the map is still determined after the batch, if it was before.
  bool keepsSessionsDetermined() const {
    if (!batch_.changesGraph()) return true;
    map::Map map = view_.map;
    graph::Graph graph = view_.graph;
    mapper::apply(batch_, {section_, view_.map.key_frames.back().stamp}, graph, map);
    const mapper::Uncertainty after(graph);
    std::map<std::uint16_t, base::VariableId> last_poses;
    for (const auto& frame : view_.map.key_frames) last_poses[frame.id.session] = frame.pose;
    return std::all_of(last_poses.begin(), last_poses.end(), [&](const auto& of_session) {
      const std::vector<base::VariableId> pose = {of_session.second};
      return !isKnown(view_.jointCovariance(pose)) || isKnown(after.joint(graph, pose));
    });
  }

  // By rounding, the variance of an undetermined direction may come out as a very large number.
  static bool isKnown(const std::optional<Eigen::MatrixXd>& covariance) {
    constexpr double kUnknown = 1e4;  // [m^2, rad^2]
    return covariance && covariance->diagonal().maxCoeff() < kUnknown;
  }

  mapper::Batch undetermined(const std::string& why) const {
    mapper::Batch nothing;
    mapper::Decision decision = newDecision();
    decision.reason = "it is undetermined which landmarks have moved: " + why;
    nothing.log(std::move(decision));
    return nothing;
  }

  mapper::Decision newDecision() const {
    mapper::Decision decision(view_.map.key_frames.back(), section_, "moved thing");
    return decision;
  }

  std::vector<Eigen::VectorXd> valuesOf(const WeighedLandmark& landmark) const {
    std::vector<Eigen::VectorXd> values;
    for (const auto id : landmark.variables) values.push_back(view_.graph.value(id));
    return values;
  }

  static void setWeights(const std::vector<base::FactorId>& factors, double weight, graph::Graph& graph) {
    for (const auto id : factors) graph.setWeight(id, weight);
  }

  // Sets the weights from before the search again. A measurement without weight gets weight 1 if it fits the current
  // map.
  void restoreWeights(const std::vector<base::FactorId>& measurements, graph::Graph& graph) const {
    for (const auto id : measurements) {
      const double before = view_.graph.factor(id).weight;
      const Eigen::VectorXd residual = graph.whitenedResidual(id);
      const double limit = graph::chiSquareQuantile(options_.confidence, static_cast<int>(residual.size()));
      graph.setWeight(id, before > 0 ? before : residual.squaredNorm() <= limit ? 1 : 0);
    }
  }

  void judge(const WeighedLandmark& landmark, std::vector<MeasuredPlace> places, graph::Graph& graph) {
    const auto enough = [&](const MeasuredPlace& place) {
      return place.measurements.size() >= static_cast<std::size_t>(options_.min_measurements);
    };
    places.erase(std::remove_if(places.begin(), places.end(), [&](const auto& place) { return !enough(place); }),
                 places.end());
    const bool moved = places.size() > 1;
    const bool stands = places.size() == 1 && isDetermined(landmark, places.front().measurements, view_.graph);
    mapper::Decision decision = newDecision();
    decision.numbers = {{"landmark", landmark.id.index},
                        {"weight", landmark.weight},
                        {"chi-square", landmark.chi2},
                        {"degrees of freedom", landmark.degrees_of_freedom},
                        {"measurements", static_cast<double>(landmark.measurements.size())},
                        {"places", static_cast<double>(places.size())}};
    decision.accepted = moved;
    decision.reason = moved    ? "moved: it was seen in more than one place"
                      : stands ? "not moved; the measurements that do not fit are left out"
                               : "retired: its measurements do not fit, and those at no single place determine it";
    batch_.log(std::move(decision));
    if (stands) {
      setWeights(places.front().measurements, 1, graph);
    } else {
      retire(landmark);
    }
    if (moved) moved_.emplace_back(landmark, std::move(places));
  }

  // Detaches the landmark from the map: its measurements stay with weight 0, and its other factors are removed.
  void retire(const WeighedLandmark& landmark) {
    for (const auto id : view_.factorsOf(landmark.id)) {
      const bool is_measurement = std::binary_search(landmark.measurements.begin(), landmark.measurements.end(), id);
      if (!is_measurement && removed_.insert(id).second) batch_.removeFactor(id);
    }
    batch_.retireLandmark(landmark.id);
  }

  void addRecord(const WeighedLandmark& landmark, const std::vector<MeasuredPlace>& places,
                 const MeasurementFrames& frames, const graph::Graph& graph) {
    const map::Landmark& gone = view_.map.landmark(landmark.id);
    auto payload = std::make_shared<MovedThingPayload>();
    payload->landmark = landmark.id;
    payload->label = gone.payload->shape(valuesOf(landmark), view_.map.key_frames).label;
    for (const MeasuredPlace& place : places) {
      const auto* first = frames.of(graph.factor(place.measurements.front()));
      const auto* last = frames.of(graph.factor(place.measurements.back()));
      std::set<base::KeyFrameId> seen_from;
      for (const auto id : place.measurements) seen_from.insert(frames.of(graph.factor(id))->id);
      const auto middle =
          middleOf(gone, valuesSeenBy(place.measurements, landmark, graph), view_.map.key_frames, seen_from);
      const auto map_from_base = geometry::fromMrpt(mapper::poseOf(graph, last->pose));
      payload->places.push_back({last->id, inverse(map_from_base) * *middle, first->stamp, last->stamp,
                                 static_cast<std::uint32_t>(place.measurements.size())});
    }
    // The record is retired as well, because it only lists where the landmark was.
    batch_.retireLandmark(batch_.addLandmark("moved thing", {}, std::move(payload)));
  }

  const DynamicLandmarksOptions& options_;
  const std::string& section_;
  const mapper::View& view_;
  std::vector<std::pair<WeighedLandmark, std::vector<MeasuredPlace>>> moved_;
  std::set<base::FactorId> removed_;
  mapper::Batch batch_;
};

}  // namespace

DynamicLandmarksPlugin::DynamicLandmarksPlugin(const DynamicLandmarksOptions& options,
                                               const mapper::PluginContext& context)
    : options_(options), section_(context.section), config_text_(context.config_text) {}

mapper::FollowUp DynamicLandmarksPlugin::afterCommit(const map::KeyFrame&, const mapper::View& view) {
  if (!config_text_.empty()) refuseUnknownSections(view.map);
  const auto every = static_cast<std::size_t>(options_.every_solves);
  if (every == 0 || view.map_is_held || view.solves.size() < searched_at_solve_ + every) return {};
  searched_at_solve_ = view.solves.size();
  return {MovedLandmarkSearch(options_, section_, view).run(), {}};
}

// One check is enough, because the landmarks of earlier sessions are in the map before the first key frame.
void DynamicLandmarksPlugin::refuseUnknownSections(const map::Map& map) {
  // No section of this copy has been read, so these are the sections of all plugins.
  auto known = base::Config::fromText(config_text_, "the INI").switchedOffPlugins();
  config_text_.clear();
  for (const auto& [id, landmark] : map.landmarks)
    if (std::find(known.begin(), known.end(), landmark.owner) == known.end()) known.push_back(landmark.owner);
  for (const auto& name : options_.landmarks) {
    if (std::find(known.begin(), known.end(), name) != known.end()) continue;
    const std::string near = base::nearestName(name, known);
    throw base::Error(base::ExitCode::unknown_key,
                      "[" + section_ + "] landmarks: '" + name + "' is neither a plugin's section of the INI nor the " +
                          "owner of a landmark of the map" + (near.empty() ? "" : "; did you mean '" + near + "'?") +
                          " (known: " + base::option_text::format(known) + ")");
  }
}

mapper::Batch DynamicLandmarksPlugin::atEnd(const mapper::View& view) {
  return view.map_is_held ? mapper::Batch() : MovedLandmarkSearch(options_, section_, view).run();
}

void DynamicLandmarksPlugin::registerKinds(mapper::Kinds& kinds) {
  MovedThingPayload::addTo(kinds.payloads);
}

}  // namespace omnimapper::plugins
