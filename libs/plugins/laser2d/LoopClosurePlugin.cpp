#include "LoopClosurePlugin.h"

#include <mrpt/obs/CObservationPointCloud.h>
#include <omnimapper/matching/ScanInBase.h>
#include <omnimapper/perception/LaserPointsExtractor.h>
#include <omnimapper/plugin/PoseFactors.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>
#include <utility>

#include "BrokenMotion.h"
#include "RevisitEvidence.h"
#include "SlipEvidence.h"
#include "WallEvidence.h"

namespace omnimapper::plugins {

namespace {

constexpr std::size_t kPlacesAsked = 3;

struct PreparedScan : mapper::Prepared {
  std::shared_ptr<const matching::ScanWithNormals> scan;  // in the base
};

}  // namespace

LoopClosurePlugin::LoopClosurePlugin(const LoopClosureOptions& options, const matching::ScanMatcherOptions& matching,
                                     const mapper::PluginContext& context)
    : options_(options), context_(context), matcher_(matching::makeMatcher(matching)), watch_(context.map_is_held) {}

bool LoopClosurePlugin::wants(const mrpt::obs::CObservation& observation) const {
  if (!dynamic_cast<const mrpt::obs::CObservationPointCloud*>(&observation)) return false;
  const auto& labels = options_.labels;
  if (labels.empty()) return perception::LaserPointsExtractor::made(observation);
  return std::find(labels.begin(), labels.end(), observation.sensorLabel) != labels.end();
}

bool LoopClosurePlugin::isSeeking() const {
  constexpr int kPatience = 20;  // key frames
  return places_ && frames_without_scan_ < kPatience;
}

std::unique_ptr<const mapper::Prepared> LoopClosurePlugin::prepare(const mrpt::obs::CObservation& observation) const {
  auto prepared = std::make_unique<PreparedScan>();
  prepared->scan = std::make_shared<const matching::ScanWithNormals>(
      matching::scanInBase(dynamic_cast<const mrpt::obs::CObservationPointCloud&>(observation)));
  return prepared;
}

mapper::Batch LoopClosurePlugin::measure(const map::KeyFrame& frame, const mapper::Observed& observed,
                                         const mapper::View& view) {
  History& history = histories_[observed.observation.sensorLabel];
  const auto& scan = dynamic_cast<const PreparedScan&>(*observed.prepared).scan;
  const std::size_t index = remember(frame, scan, view, history);
  if (scan->empty()) return {};
  frames_without_scan_ = 0;
  watchSession(frame, observed.observation.sensorLabel, history[index].key_scan.travel, view);
  seekInMap(observed.observation.sensorLabel, history, index, view);
  closures_.noteSolves(view.solves.size());
  seekGlobally(observed.observation.sensorLabel, history, index, view);
  seekSlip(history, view);
  const double travel = history[index].key_scan.travel;
  const auto [last, is_first] = searched_.emplace(observed.observation.sensorLabel, travel);
  // A run that only localizes searches at every key frame: the pose matters now, and the cost does not grow.
  const bool is_soon = !is_first && std::abs(travel - last->second) < options_.spacing;
  if (is_soon && !context_.map_is_held) return {};
  auto places = loopPlaces(frame, history, index, view);
  if (!places.empty()) {
    last->second = travel;
    searches_.emplace_back(options_, context_, matcher_,
                           keyScans(history, index, options_.context + options_.max_window, 0), std::move(places));
    searches_.back().testSessionsWith(places_, observed.observation.sensorLabel);
    const auto tied = closures_.newestTied(view.graph);
    const auto broken = newestBreak(history, index, StampedScan::Since::broken);
    if (broken && (!tied || history[*broken].stamp > *tied))
      searches_.back().setBroken(history[*broken].key_scan.travel);
  }
  return {};
}

void LoopClosurePlugin::watchSession(const map::KeyFrame& frame, const std::string& label, double travel,
                                     const mapper::State& state) {
  if (!places_) return;
  const auto& session = state.map.sessions.back();
  if (session.aligned && frame.id.session == session.number) {
    watch_.add(*places_, label, frame, travel, state);
  } else {
    watch_.reset(travel);
  }
}

LoopClosurePlugin::Says LoopClosurePlugin::aboutSession() const {
  if (!places_) return Says::unable;
  if (watch_.isContradicted()) return Says::contradicted;
  return watch_.isConfirmed() ? Says::confirmed : Says::nothing;
}

// What the session sees contradicts the map: the closures that tie it to earlier sessions are wrong. Without them it is
// searched for again.
mapper::Batch LoopClosurePlugin::takenBack(const map::KeyFrame& frame, const mapper::State& state) {
  mapper::Batch batch;
  if (context_.map_is_held || !watch_.isContradicted()) return batch;
  watch_.reset(watch_.travel());
  const auto session = state.map.sessions.back().number;
  double count = 0;
  for (const auto id : closures_.between(session, state.graph)) {
    batch.removeFactor(id);
    ++count;
  }
  if (count == 0) return batch;
  mapper::Decision decision(frame, context_.section, mapper::kRelocalization);
  decision.reason = "what the session sees contradicts the map: the closures that tied it there are taken back";
  decision.numbers = {{"closures", count}};
  batch.log(std::move(decision));
  return batch;
}

std::size_t LoopClosurePlugin::remember(const map::KeyFrame& frame, const Scan& scan, const mapper::State& state,
                                        History& history) {
  const auto after = std::upper_bound(history.begin(), history.end(), std::tuple(frame.id.session, frame.stamp),
                                      [](const auto& wanted, const StampedScan& stamped) {
                                        return wanted < std::tuple(stamped.key_scan.frame.session, stamped.stamp);
                                      });
  double travel = 0;
  auto since = StampedScan::Since::known;
  if (after != history.begin()) {
    const auto& before = *std::prev(after);
    const auto& map_from_before = state.map.keyFrame(before.key_scan.frame).map_from_base;
    // How far the base was moved between sessions is unknown: places of earlier sessions count as left long ago.
    const bool same_session = before.key_scan.frame.session == frame.id.session;
    travel = before.key_scan.travel +
             (same_session ? (frame.map_from_base - map_from_before).translation().norm() : 2 * options_.min_travel);
    const auto covariance = same_session ? state.covarianceBetween(before.key_scan.frame, frame.id) : std::nullopt;
    if (covariance && usual_motion_.isWeak(*covariance))
      since = isBrokenMotion(*covariance) ? StampedScan::Since::broken : StampedScan::Since::weak;
  }
  closures_.add(frame);
  const auto place = history.insert(after, {{frame.id, scan, travel}, frame.stamp, since});
  return static_cast<std::size_t>(place - history.begin());
}

// Searches for a slip whenever another global closure was refused. Key frames without a scan of this sensor get an
// empty one, because the motion between them may have slipped, too.
void LoopClosurePlugin::seekSlip(const History& history, const mapper::View& view) {
  if (context_.map_is_held) return;
  auto refused = closures_.refusedGlobally(view.graph);
  const bool has_more = refused.size() > refused_before_ && refused.size() > 1;
  refused_before_ = refused.size();
  if (!has_more) return;
  static const auto kNothingSeen = std::make_shared<const matching::ScanWithNormals>();
  std::vector<LoopSearch::KeyScan> trajectory;
  auto stamped = history.begin();
  for (const auto& frame : view.map.key_frames) {
    const bool has_scan = stamped != history.end() && stamped->key_scan.frame == frame.id;
    const double travel = trajectory.empty() ? 0 : trajectory.back().travel;
    trajectory.push_back(has_scan ? stamped++->key_scan : LoopSearch::KeyScan{frame.id, kNothingSeen, travel});
  }
  slip_searches_.emplace_back(options_, context_, matcher_, std::move(refused), std::move(trajectory));
}

std::optional<std::size_t> LoopClosurePlugin::newestBreak(const History& history, std::size_t index,
                                                          StampedScan::Since least) {
  const auto session = history[index].key_scan.frame.session;
  for (std::size_t i = index + 1; i-- > 0 && history[i].key_scan.frame.session == session;) {
    if (history[i].since >= least) return i;
  }
  return std::nullopt;
}

// Distance travelled [m] since the newest key frame that is not after `stamp`, or since the session began.
double LoopClosurePlugin::travelSince(std::optional<base::Stamp> stamp, const History& history, std::size_t index) {
  const auto& newest = history[index].key_scan;
  std::size_t i = index;
  while (i > 0 && history[i - 1].key_scan.frame.session == newest.frame.session &&
         (!stamp || history[i].stamp > *stamp))
    --i;
  return newest.travel - history[i].key_scan.travel;
}

// Searches become rarer the longer nothing is found, because new ground has no loops, and the larger the map is,
// because searching it costs more.
void LoopClosurePlugin::seekGlobally(const std::string& label, const History& history, std::size_t index,
                                     const mapper::State& state) {
  constexpr double kSpacing = 3;  // [m]
  // Spacing of searches as a share of the travel since the last answer; kShareOfAll is a share of all travel.
  constexpr double kShareOfLost = 0.1, kShareOnNewGround = 0.5;
  constexpr double kShareOfAll = 0.01;
  constexpr double kGrown = 1.2;  // growth of the map at which the database is rebuilt
  if (context_.map_is_held || !state.map.sessions.back().aligned) return;
  const double travel = history[index].key_scan.travel;
  const auto tied = closures_.newestTied(state.graph);
  const auto broken = newestBreak(history, index);
  const bool is_broken = broken && history[*broken].since == StampedScan::Since::broken &&
                         (!tied || history[*broken].stamp > *tied) &&
                         travel - history[*broken].key_scan.travel >= options_.context;
  if (!is_broken && travelSince(tied, history, index) < options_.lost_travel) return;
  const auto answered = std::max(tied, closures_.newestWithNote(state.graph, kGlobalClosure));
  const double since_answer = travelSince(answered, history, index);
  const double spacing = is_broken ? kSpacing : std::max({kSpacing, kShareOfLost * since_answer, kShareOfAll * travel});
  LastGlobalSearch& last = last_global_search_[label];
  if (last.travel > 0 && std::abs(travel - last.travel) < spacing) return;
  last.travel = travel;
  const double rarely = std::max(kSpacing, kShareOnNewGround * since_answer);
  const bool on_new_ground = std::abs(travel - last.on_new_ground) >= rarely;
  if (on_new_ground) last.on_new_ground = travel;
  std::vector<LoopSearch::KeyScan> earlier;
  for (std::size_t i = 0; i < index; ++i) {
    if (travel - history[i].key_scan.travel < options_.min_travel && !(is_broken && i < *broken)) break;
    earlier.push_back(history[i].key_scan);
  }
  if (earlier.empty()) return;
  const bool has_grown = static_cast<double>(earlier.size()) > kGrown * static_cast<double>(last.size);
  const bool is_moved = tied != last.tied || closures_.corrections() != last.corrections;
  if (!last.places || has_grown || is_moved) {
    last.places = placesToLoopTo(state.map, label, earlier, matcher_);
    last.size = earlier.size();
    last.tied = tied;
    last.corrections = closures_.corrections();
  }
  global_searches_.emplace_back(options_, context_, matcher_, last.places, label,
                                keyScans(history, index, options_.join_travel + kSpacing, 0), std::move(earlier),
                                on_new_ground);
}

// Searches become rarer without an answer, because a session of another place is never aligned with the map, and
// frequent again once an answer has moved the session.
void LoopClosurePlugin::seekInMap(const std::string& label, const History& history, std::size_t index,
                                  const mapper::State& state) {
  constexpr double kSpacing = 3,
                   kShareOfTravel = 0.1;  // between searches: [m], and share of the travel without an answer
  constexpr double kMoved = 1;            // [m] of the start of the session
  if (!places_) return;
  const auto& session = state.map.sessions.back();
  const auto& key_scan = history[index].key_scan;
  if (session.aligned || key_scan.frame.session != session.number) return;
  const auto first = std::find_if(history.begin(), history.end(), [&](const StampedScan& stamped) {
    return stamped.key_scan.frame.session == session.number;
  });
  const double travel = key_scan.travel - first->key_scan.travel;
  const auto begun_at = mapper::poseOf(state.graph, session.anchor).translation();
  const auto [entry, is_first] = last_relocalization_.try_emplace(label, LastRelocalization{travel, travel, begun_at});
  LastRelocalization& last = entry->second;
  if ((begun_at - last.begun_at).norm() > kMoved) last.answered = last.travel;
  last.begun_at = begun_at;
  if (!is_first && travel - last.travel < std::max(kSpacing, kShareOfTravel * (travel - last.answered))) return;
  last.travel = travel;
  relocalizations_.emplace_back(options_, context_, matcher_, places_, label,
                                keyScans(history, index, options_.join_travel + kSpacing, 0), travel);
}

void LoopClosurePlugin::restore(const map::MapSection*, const mapper::View& view) {
  std::set<std::uint16_t> unaligned;
  for (const auto& session : view.map.sessions) {
    if (!session.aligned) unaligned.insert(session.number);
  }
  for (const auto& frame : view.map.key_frames) {
    // A run that only localizes never ties an unaligned session, so its poses stay unknown.
    if (context_.map_is_held && unaligned.count(frame.id.session) > 0) continue;
    for (const auto& observation : frame.observations) {
      if (!wants(*observation)) continue;
      const auto prepared = prepare(*observation);
      remember(frame, dynamic_cast<const PreparedScan&>(*prepared).scan, view, histories_[observation->sensorLabel]);
    }
  }
  if (view.map.key_frames.empty()) return;
  std::map<std::string, std::vector<LoopSearch::KeyScan>> key_scans;
  for (const auto& [label, history] : histories_) {
    // A plugin that is added during a session does not search for that session in its own scans.
    for (const auto& stamped : history)
      if (stamped.key_scan.frame.session != view.map.sessions.back().number)
        key_scans[label].push_back(stamped.key_scan);
  }
  auto places = std::make_shared<const ScanDatabase>(view.map, key_scans, matcher_);
  if (!places->empty()) places_ = std::move(places);
}

void LoopClosurePlugin::retired(const map::KeyFrame& frame) {
  for (auto& [label, history] : histories_) {
    const auto stamped = std::lower_bound(history.begin(), history.end(), std::tuple(frame.id.session, frame.stamp),
                                          [](const StampedScan& one, const auto& wanted) {
                                            return std::tuple(one.key_scan.frame.session, one.stamp) < wanted;
                                          });
    if (stamped != history.end() && stamped->key_scan.frame == frame.id) history.erase(stamped);
  }
}

mapper::FollowUp LoopClosurePlugin::afterCommit(const map::KeyFrame& frame, const mapper::View& view) {
  ++frames_without_scan_;
  mapper::FollowUp follow_up;
  follow_up.batch = takenBack(frame, view);
  if (follow_up.batch.empty()) follow_up.batch = closures_.proposedAgain(view, context_.section);
  for (auto& search : searches_) follow_up.jobs.push_back({"loop closure of " + toString(frame.id), std::move(search)});
  for (auto& search : global_searches_)
    follow_up.jobs.push_back({"global loop search of " + toString(frame.id), std::move(search)});
  for (auto& search : slip_searches_)
    follow_up.jobs.push_back({"slip search of " + toString(frame.id), std::move(search)});
  for (auto& search : relocalizations_)
    follow_up.jobs.push_back({"relocalization of " + toString(frame.id), std::move(search)});
  searches_.clear();
  global_searches_.clear();
  slip_searches_.clear();
  relocalizations_.clear();
  return follow_up;
}

// The last solve has tested all closures.
mapper::Batch LoopClosurePlugin::atEnd(const mapper::View& view) {
  closures_.noteSolves(view.solves.size() + 1);
  return closures_.proposedAgain(view, context_.section);
}

std::vector<mapper::Evidence> LoopClosurePlugin::evidence(const mapper::View& view) const {
  if (histories_.empty()) return {};  // without scans there is no evidence
  std::vector<std::string> labels;
  for (const auto& [label, history] : histories_) labels.push_back(label);
  auto all = revisits(view, context_.section, labels, options_.min_travel);
  const auto walls = throughWalls(view.map, labels);
  all.insert(all.begin(), walls.begin(), walls.end());
  for (auto& one : slips(view, context_.section, view.decisions)) all.push_back(std::move(one));
  for (auto& one : brokenMotions(view)) all.push_back(std::move(one));
  return all;
}

std::vector<LoopSearch::KeyScan> LoopClosurePlugin::keyScans(const History& history, std::size_t centre, double before,
                                                             double after) {
  const auto& middle = history[centre].key_scan;
  const auto belongs = [&](std::size_t i) {
    const auto& key_scan = history[i].key_scan;
    return key_scan.frame.session == middle.frame.session && key_scan.travel >= middle.travel - before &&
           key_scan.travel <= middle.travel + after;
  };
  const auto is_known = [&](std::size_t i) { return history[i].since == StampedScan::Since::known; };
  std::size_t first = centre, end = centre + 1;
  while (first > 0 && is_known(first) && belongs(first - 1)) --first;
  while (end < history.size() && is_known(end) && belongs(end)) ++end;
  // A base that turns on the spot sees the same walls again and again: a part of many scans is enough.
  constexpr std::size_t kMost = 200;
  const std::size_t stride = 1 + (end - first) / kMost;
  std::vector<LoopSearch::KeyScan> all;
  for (std::size_t i = first; i < end; ++i) {
    if (i == centre || (i - first) % stride == 0) all.push_back(history[i].key_scan);
  }
  return all;
}

// The nearest place of each earlier pass, with the scans around it. There are more places than will be tried, because
// only the job knows their uncertainty.
std::vector<LoopSearch::Place> LoopClosurePlugin::loopPlaces(const map::KeyFrame& frame, const History& history,
                                                             std::size_t index, const mapper::State& state) const {
  std::vector<std::pair<double, std::size_t>> near;
  // Across a motion that is not well known, places that were left just now are tried, too, once enough was seen since.
  constexpr std::size_t kEnoughScans = 5;
  std::size_t broken = newestBreak(history, index).value_or(0);
  if (history[index].key_scan.travel - history[broken].key_scan.travel < 0.5 * options_.context &&
      index - broken < kEnoughScans)
    broken = 0;
  for (std::size_t i = 0; i < index; ++i) {
    const double travel = history[index].key_scan.travel - history[i].key_scan.travel;
    if (travel < options_.min_travel && i >= broken) break;
    if (context_.map_is_held && history[i].key_scan.frame.session == frame.id.session) break;
    const auto& place = state.map.keyFrame(history[i].key_scan.frame).map_from_base;
    const double distance = (place.translation() - frame.map_from_base.translation()).norm();
    if (distance <= options_.radius + options_.max_window) near.emplace_back(distance, i);
  }
  std::sort(near.begin(), near.end());
  const double around = 2 * options_.context + options_.max_window;
  std::vector<std::size_t> chosen;
  std::vector<LoopSearch::Place> places;
  for (const auto& candidate : near) {
    const std::size_t i = candidate.second;
    // Places close to a chosen one along the path would only repeat its search.
    const bool repeats = std::any_of(chosen.begin(), chosen.end(), [&](std::size_t other) {
      return std::abs(history[other].key_scan.travel - history[i].key_scan.travel) < options_.min_travel;
    });
    if (repeats) continue;
    chosen.push_back(i);
    places.push_back({history[i].key_scan, keyScans(history, i, around, around)});
    if (places.size() == kPlacesAsked * static_cast<std::size_t>(options_.candidates)) break;
  }
  return places;
}

}  // namespace omnimapper::plugins
