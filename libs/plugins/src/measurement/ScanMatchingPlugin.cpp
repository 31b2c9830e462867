#include <mrpt/obs/CObservationPointCloud.h>
#include <omnimapper/plugins/ScanMatchingPlugin.h>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "ScanFactor.h"
#include "ScanInBase.h"

IMPLEMENTS_MRPT_OBJECT(ScanMatchingPluginFactory, omnimapper::mapper::MeasurementPluginFactory, omnimapper::plugins)

namespace omnimapper::plugins {

namespace {

constexpr const char* kCloudSuffix = ".points";

struct PreparedScan : mapper::Prepared {
  std::shared_ptr<const matching::PlanarScan> scan;  // in the base
};

}  // namespace

const base::OptionTable<ScanMatchingOptions>& ScanMatchingOptions::table() {
  using Options = ScanMatchingOptions;
  static const auto table =
      base::OptionTable<Options>()
          .list("labels", &Options::labels, "Labels of the clouds to match; empty for all made from 2D scans.")
          .integer("local_frames", &Options::local_frames, base::Range{1, 1000},
                   "A scan is matched against the scans of so many key frames before it.")
          .number("min_overlap", &Options::min_overlap, base::Range{0, 1},
                  "Share of the points that must find a partner.")
          .number("max_correction_m", &Options::max_correction, base::Range::positive(),
                  "A match farther from the prediction is refused.")
          .number("max_turn_correction_deg", &Options::max_turn_correction, base::Range{0, 180},
                  "A match turned farther from the prediction is refused.")
          .number("point_sigma_m", &Options::point_sigma, base::Range::positive(),
                  "Standard deviation of a point from the wall it lies on.")
          .number("wall_sigma_factor", &Options::wall_sigma_factor, base::Range::notNegative(),
                  "The same as a multiple of the distance that the points of a match have from the walls; the larger "
                  "counts.")
          .number("position_sigma_floor_m", &Options::position_sigma_floor, base::Range::positive(),
                  "No match is trusted more than this.")
          .number("angle_sigma_floor_deg", &Options::angle_sigma_floor, base::Range::positive(),
                  "No match is trusted more than this.")
          .flag("close_loops", &Options::close_loops, "Match against places seen long ago.")
          .number("loop_radius_m", &Options::loop_radius, base::Range::positive(),
                  "Places whose estimate is within this distance are tried.")
          .number("loop_min_way_m", &Options::loop_min_way, base::Range::positive(),
                  "Places left less than this way ago are no loop.")
          .integer("loop_frames", &Options::loop_frames, base::Range{0, 1000},
                   "Key frames before and after a place that make its local map.")
          .integer("loop_candidates", &Options::loop_candidates, base::Range{1, 1000}, "Places tried per key frame.")
          .number("loop_min_overlap", &Options::loop_min_overlap, base::Range{0, 1},
                  "Share of the points that must find a partner.")
          .number("loop_max_distance_m", &Options::loop_max_distance, base::Range::positive(),
                  "Largest distance of paired points at the start.")
          .number("loop_max_correction_m", &Options::loop_max_correction, base::Range::positive(),
                  "A closure farther from the prediction is refused.")
          .number("loop_max_turn_correction_deg", &Options::loop_max_turn_correction, base::Range{0, 180},
                  "A closure turned farther from the prediction is refused.")
          .number("loop_position_sigma_floor_m", &Options::loop_position_sigma_floor, base::Range::positive(),
                  "No closure is trusted more than this: its local map is as bent as the trajectory was then.")
          .number("loop_angle_sigma_floor_deg", &Options::loop_angle_sigma_floor, base::Range::positive(),
                  "No closure is trusted more than this.")
          .number("loop_loss_scale", &Options::loop_loss_scale, base::Range::positive(),
                  "Scale of the Cauchy loss on closures, in standard deviations.");
  return table;
}

ScanMatchingPlugin::ScanMatchingPlugin(const ScanMatchingOptions& options, const matching::ScanMatcherOptions& matching,
                                       const mapper::PluginContext& context)
    : options_(options), context_(context), sequential_matcher_(matching::makeMatcher(matching)), loop_matcher_([&] {
        auto wide = matching;
        wide.max_distance = options.loop_max_distance;
        return matching::makeMatcher(wide);
      }()) {}

bool ScanMatchingPlugin::wants(const mrpt::obs::CObservation& observation) const {
  if (!dynamic_cast<const mrpt::obs::CObservationPointCloud*>(&observation)) return false;
  const std::string& label = observation.sensorLabel;
  if (!options_.labels.empty()) {
    return std::find(options_.labels.begin(), options_.labels.end(), label) != options_.labels.end();
  }
  const std::string suffix = kCloudSuffix;
  return label.size() >= suffix.size() && label.compare(label.size() - suffix.size(), suffix.size(), suffix) == 0;
}

std::unique_ptr<const mapper::Prepared> ScanMatchingPlugin::prepare(const mrpt::obs::CObservation& observation) const {
  auto prepared = std::make_unique<PreparedScan>();
  prepared->scan = std::make_shared<const matching::PlanarScan>(
      scanInBase(dynamic_cast<const mrpt::obs::CObservationPointCloud&>(observation)));
  return prepared;
}

mapper::Batch ScanMatchingPlugin::measure(const map::KeyFrame& frame, const mapper::Observed& observed,
                                          const mapper::View& view) {
  History& history = histories_[observed.observation.sensorLabel];
  const auto& scan = dynamic_cast<const PreparedScan&>(*observed.prepared).scan;
  const std::size_t index = remember(frame, scan, view, history);
  mapper::Batch batch;
  if (index == 0 || scan->empty()) return batch;
  matchSequential(frame, history, index, view, batch);
  if (options_.close_loops) {
    auto places = loopPlaces(frame, history, index, view);
    if (!places.empty())
      searches_.emplace_back(options_, context_, loop_matcher_, history[index].sight, std::move(places));
  }
  return batch;
}

std::size_t ScanMatchingPlugin::remember(const map::KeyFrame& frame, const Scan& scan, const mapper::State& state,
                                         History& history) const {
  const auto after = std::upper_bound(
      history.begin(), history.end(), std::tuple(frame.id.session, frame.stamp),
      [](const auto& wanted, const Seen& seen) { return wanted < std::tuple(seen.sight.frame.session, seen.stamp); });
  double way = 0;
  if (after != history.begin()) {
    const auto& before = *std::prev(after);
    const auto& map_from_before = state.map.keyFrame(before.sight.frame).map_from_base;
    // How far the base was carried between sessions nobody knows: all of an earlier one counts as left long ago.
    const bool same_session = before.sight.frame.session == frame.id.session;
    way = before.way +
          (same_session ? (frame.map_from_base - map_from_before).translation().norm() : 2 * options_.loop_min_way);
  }
  const auto place = history.insert(after, {{frame.id, scan}, frame.stamp, way});
  return static_cast<std::size_t>(place - history.begin());
}

void ScanMatchingPlugin::restore(const map::MapSection*, const mapper::View& view) {
  for (const auto& frame : view.map.key_frames) {
    for (const auto& observation : frame.observations) {
      if (!wants(*observation)) continue;
      const auto prepared = prepare(*observation);
      remember(frame, dynamic_cast<const PreparedScan&>(*prepared).scan, view, histories_[observation->sensorLabel]);
    }
  }
}

void ScanMatchingPlugin::matchSequential(const map::KeyFrame& frame, const History& history, std::size_t index,
                                         const mapper::State& state, mapper::Batch& batch) const {
  const auto frames = static_cast<std::size_t>(options_.local_frames);
  const auto& before = state.map.keyFrame(history[index - 1].sight.frame);
  if (before.id.session != frame.id.session) return;
  const auto scans = sights(history, index > frames ? index - frames : 0, index, index);
  const auto reference = localMap(scans, before.id, state);
  const auto guess = planar(frame.map_from_base - before.map_from_base);
  const auto match =
      sequential_matcher_->match(*sequential_matcher_->prepare(reference), *history[index].sight.scan, {guess});

  auto decision = judge(match, guess, {options_.min_overlap, options_.max_correction, options_.max_turn_correction});
  decision.stamp = frame.stamp;
  decision.plugin = context_.section;
  decision.kind = "sequential match";
  decision.from = frame.id;
  decision.to = before.id;
  if (decision.accepted)
    batch.addFactor(scanFactor(options_, options_.position_sigma_floor, options_.angle_sigma_floor, context_,
                               before.pose, frame.pose, match));
  batch.log(std::move(decision));
}

mapper::FollowUp ScanMatchingPlugin::afterCommit(const map::KeyFrame& frame, const mapper::View&) {
  mapper::FollowUp follow_up;
  for (auto& search : searches_) follow_up.jobs.push_back({"loop closure of " + toString(frame.id), std::move(search)});
  searches_.clear();
  return follow_up;
}

std::vector<LoopSearch::Sight> ScanMatchingPlugin::sights(const History& history, std::size_t first, std::size_t end,
                                                          std::size_t centre) {
  std::vector<LoopSearch::Sight> all;
  for (std::size_t i = first; i < end; ++i) {
    if (history[i].sight.frame.session == history[centre].sight.frame.session) all.push_back(history[i].sight);
  }
  return all;
}

// The nearest place of each earlier pass, with the scans around it.
std::vector<LoopSearch::Place> ScanMatchingPlugin::loopPlaces(const map::KeyFrame& frame, const History& history,
                                                              std::size_t index, const mapper::State& state) const {
  std::vector<std::pair<double, std::size_t>> near;
  for (std::size_t i = 0; i < index; ++i) {
    if (history[index].way - history[i].way < options_.loop_min_way) break;
    const auto& place = state.map.keyFrame(history[i].sight.frame).map_from_base;
    const double distance = (place.translation() - frame.map_from_base.translation()).norm();
    if (distance <= options_.loop_radius) near.emplace_back(distance, i);
  }
  std::sort(near.begin(), near.end());
  const auto around = static_cast<std::size_t>(options_.loop_frames);
  std::vector<std::size_t> chosen;
  std::vector<LoopSearch::Place> places;
  for (const auto& [distance, i] : near) {
    // Neighbours along the path would only repeat it.
    const bool repeats = std::any_of(chosen.begin(), chosen.end(), [&](std::size_t other) {
      return std::abs(history[other].way - history[i].way) < options_.loop_min_way;
    });
    if (repeats) continue;
    chosen.push_back(i);
    const std::size_t first = i > around ? i - around : 0, end = std::min(i + around + 1, index);
    places.push_back({history[i].sight.frame, sights(history, first, end, i)});
    if (places.size() == static_cast<std::size_t>(options_.loop_candidates)) break;
  }
  return places;
}

namespace {
std::vector<base::OptionSpec> joined(std::vector<base::OptionSpec> a, const std::vector<base::OptionSpec>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

std::vector<std::string> keysOf(const std::vector<base::OptionSpec>& specs) {
  std::vector<std::string> keys = mapper::sectionKeysOfEngine();
  for (const auto& spec : specs) keys.push_back(spec.key);
  return keys;
}
}  // namespace

const std::vector<base::OptionSpec>& ScanMatchingPluginFactory::options() const {
  static const auto specs = joined(ScanMatchingOptions::table().specs(), matching::ScanMatcherOptions::table().specs());
  return specs;
}

std::unique_ptr<mapper::MeasurementPlugin> ScanMatchingPluginFactory::make(const base::ConfigSection& section,
                                                                           const mapper::PluginContext& context) const {
  const auto keys = keysOf(options());
  return std::make_unique<ScanMatchingPlugin>(section.read<ScanMatchingOptions>(keys),
                                              section.read<matching::ScanMatcherOptions>(keys), context);
}

}  // namespace omnimapper::plugins
