#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/graph/Between.h>
#include <omnimapper/matching/CorrelativeSearch.h>
#include <omnimapper/plugins/SlipSearch.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <utility>

#include "GlobalMatcher.h"
#include "ScanFactor.h"

namespace omnimapper::plugins {

using mrpt::math::TPose2D;

namespace {

constexpr double kCycleSigmas = 3;
constexpr double kSameSlip = 0.3, kSameSlipTurn = 0.1;  // [m] [rad] within which two motions are one
constexpr double kSlipDegree = base::option_text::kRadiansPerDegree;

// What a factor between two poses measured, in the plane.
std::optional<TPose2D> measuredBy(const graph::Factor& factor) {
  if (const auto* planar = dynamic_cast<const graph::BetweenSe2*>(&factor)) return geometry::toMrpt(planar->measured());
  if (const auto* spatial = dynamic_cast<const graph::BetweenSe3*>(&factor))
    return geometry::toMrpt(geometry::project(spatial->measured()));
  return std::nullopt;
}

TPose2D inverseOf(const TPose2D& pose) {
  return TPose2D() - pose;
}

}  // namespace

// From key frame drive_[before] to the next.
struct SlipSearch::Span {
  std::size_t before = 0;
  TPose2D estimated, required;  // the motion as the map has it, and as the closures ask for
  double score = 0;             // of the scans, moved as required, over that as the map has it
  matching::ScanMatch match;    // near what is required
  double overlap = 0;           // as the map has it
};

SlipSearch::SlipSearch(const LoopClosureOptions& options, const mapper::PluginContext& context,
                       std::shared_ptr<const matching::ScanMatcher> matcher, std::vector<base::FactorId> refused,
                       std::vector<LoopSearch::Sight> drive)
    : options_(options),
      context_(context),
      matcher_(std::move(matcher)),
      refused_(std::move(refused)),
      drive_(std::move(drive)) {}

mapper::Batch SlipSearch::operator()(const mapper::State& state) const {
  mapper::Batch batch;
  const auto agreeing = this->agreeing(state);
  if (agreeing.size() < 2) return batch;
  const auto candidates = spans(agreeing, state);
  mapper::Decision decision;
  decision.plugin = context_.section;
  decision.kind = kSlip;
  decision.from = drive_[agreeing.front().newest].frame;
  decision.to = drive_[agreeing.front().place].frame;
  decision.stamp = state.map.keyFrame(decision.from).stamp;
  decision.numbers = {{"closures that agree", static_cast<double>(agreeing.size())},
                      {"spans that may have slipped", static_cast<double>(candidates.size())}};
  const auto slipped = thatSlipped(candidates, state);
  if (!slipped) {
    decision.reason = "closures that agree with one another contradict the map, and no single span explains it";
    batch.log(std::move(decision));
    return batch;
  }
  const auto& before = state.map.keyFrame(drive_[slipped->before].frame);
  const auto& after = state.map.keyFrame(drive_[slipped->before + 1].frame);
  const auto& motion = slipped->match.reference_from_scan;
  const auto apart = distanceBetween(motion, slipped->estimated);
  decision.from = after.id;
  decision.to = before.id;
  decision.stamp = after.stamp;
  decision.numbers.insert(decision.numbers.end(), {{kSlippedBy, apart.metres},
                                                   {kSlippedByAngle, apart.radians / kSlipDegree},
                                                   {"overlap", slipped->match.overlap},
                                                   {"overlap as it was", slipped->overlap}});
  decision.accepted = true;
  decision.reason = "closures that agree contradict the motion here, and the scans fit better as they say";
  for (const auto id : state.graph.factorsOf(after.pose)) {
    const auto& record = state.graph.factor(id);
    if (record.variables == std::vector<base::VariableId>{before.pose, after.pose} && !record.tags.hypothesis)
      batch.setWeight(id, 0);
  }
  auto measured = scanFactor(options_, context_, before.pose, after.pose, slipped->match);
  measured.tags.note = kSlip;
  batch.addFactor(std::move(measured));
  batch.log(std::move(decision));
  return batch;
}

TPose2D SlipSearch::motion(std::size_t from, std::size_t to, const mapper::State& state) const {
  return planar(state.map.keyFrame(drive_[to].frame).map_from_base -
                state.map.keyFrame(drive_[from].frame).map_from_base);
}

std::vector<SlipSearch::Closure> SlipSearch::closures(const mapper::State& state) const {
  std::unordered_map<base::VariableId, std::size_t> index;
  for (std::size_t i = 0; i < drive_.size(); ++i) index[state.map.keyFrame(drive_[i].frame).pose] = i;
  std::vector<Closure> all;
  for (const auto id : refused_) {
    if (!state.graph.contains(id) || state.graph.factor(id).weight > 0) continue;
    const auto& record = state.graph.factor(id);
    const auto measured = measuredBy(*record.factor);
    if (!measured || record.variables.size() != 2) continue;
    const auto place = index.find(record.variables[0]), newest = index.find(record.variables[1]);
    if (place == index.end() || newest == index.end() || place->second >= newest->second) continue;
    all.push_back({place->second, newest->second, *measured});
  }
  return all;
}

// Those that agree with the newest, it included; that with the earliest end first. The cycle of two closures goes over
// the short spans between their ends alone, so it holds however wrong the map is between place and end.
std::vector<SlipSearch::Closure> SlipSearch::agreeing(const mapper::State& state) const {
  auto all = closures(state);
  if (all.empty()) return all;
  const Closure newest =
      *std::max_element(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.newest < b.newest; });
  const auto between = [&](std::size_t a, std::size_t b) {
    return a == b ? std::optional(Eigen::Matrix<double, 6, 6>(Eigen::Matrix<double, 6, 6>::Zero()))
                  : state.covarianceBetween(drive_[std::min(a, b)].frame, drive_[std::max(a, b)].frame);
  };
  const auto disagrees = [&](const Closure& one) {
    if (one.newest == newest.newest) return one.place != newest.place;
    const auto places = between(one.place, newest.place), ends = between(one.newest, newest.newest);
    if (!places || !ends) return true;
    const TPose2D predicted =
        motion(newest.place, one.place, state) + one.place_from_newest + motion(one.newest, newest.newest, state);
    const double reach =
        std::hypot(predicted.x, predicted.y) + std::hypot(one.place_from_newest.x, one.place_from_newest.y);
    const double yaw = kCycleSigmas * std::sqrt((*places)(5, 5) + (*ends)(5, 5)) + 2 * options_.angle_sigma_floor;
    const double position =
        kCycleSigmas * std::sqrt(std::max((*places)(0, 0), (*places)(1, 1)) + std::max((*ends)(0, 0), (*ends)(1, 1)));
    return !distanceBetween(predicted, newest.place_from_newest)
                .within(kSameSlip + position + 2 * options_.angle_sigma_floor * reach, kSameSlipTurn / 2 + yaw);
  };
  all.erase(std::remove_if(all.begin(), all.end(), disagrees), all.end());
  std::sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.newest < b.newest; });
  return all;
}

// Those between all the places and all the ends, which no base could not have driven as the closures ask for.
std::vector<SlipSearch::Span> SlipSearch::spans(const std::vector<Closure>& agreeing,
                                                const mapper::State& state) const {
  constexpr double kMostMotion = 3;  // [m] from one key frame to the next, beside what was measured
  const Closure& first = agreeing.front();
  std::size_t begin = 0;
  for (const auto& closure : agreeing) begin = std::max(begin, closure.place);
  std::vector<Span> all;
  for (std::size_t i = begin; i < first.newest; ++i) {
    if (drive_[i].frame.session != drive_[i + 1].frame.session) continue;
    Span span;
    span.before = i;
    span.estimated = motion(i, i + 1, state);
    span.required = inverseOf(motion(first.place, i, state)) + first.place_from_newest +
                    inverseOf(motion(i + 1, first.newest, state));
    const double reach = kMostMotion + std::hypot(span.estimated.x, span.estimated.y);
    if (std::hypot(span.required.x, span.required.y) > reach) continue;
    if (distanceBetween(span.required, span.estimated).within(kSameSlip, kSameSlipTurn)) continue;
    all.push_back(span);
  }
  return all;
}

matching::PlanarScan SlipSearch::seenBefore(const Span& span, const mapper::State& state) const {
  std::vector<LoopSearch::Sight> sights;
  for (std::size_t i = span.before + 1; i-- > 0;) {
    if (drive_[span.before].way - drive_[i].way > 2 * options_.context) break;
    sights.push_back(drive_[i]);
  }
  return localMap(sights, drive_[span.before].frame, state);
}

matching::PlanarScan SlipSearch::seenAfter(const Span& span, const mapper::State& state) const {
  std::vector<LoopSearch::Sight> sights;
  for (std::size_t i = span.before + 1; i < drive_.size(); ++i) {
    if (drive_[i].way - drive_[span.before + 1].way > options_.context) break;
    sights.push_back(drive_[i]);
  }
  return localMap(sights, drive_[span.before + 1].frame, state);
}

// All of them by a search around what is required, for the map between errs, too; then the fine matcher on the best.
std::optional<SlipSearch::Span> SlipSearch::thatSlipped(std::vector<Span> spans, const mapper::State& state) const {
  constexpr double kWindow = 0.8, kWindowTurn = 8 * kSlipDegree;  // [m] [rad]
  constexpr double kSpacing = 0.25, kFine = 0.08;                 // [m] between the points that are matched
  constexpr double kLeastScore = 0.4, kLeastOverlap = 0.6;
  constexpr double kBetter = 0.1;  // of the overlap, than as the map has it
  constexpr std::size_t kMost = 5;
  matching::LikelihoodOptions grid;
  grid.cell = 0.1;
  grid.sigma = 0.1;
  matching::SearchOptions limits;
  limits.min_score = kLeastScore;
  limits.max_results = 1;
  limits.max_blocks = 2000;
  for (auto& span : spans) {
    const matching::LikelihoodPyramid pyramid(seenBefore(span, state).points, grid);
    const auto query = matching::oncePerCell(seenAfter(span, state), kSpacing).points;
    const auto found = matching::search(pyramid, query, {span.required, kWindow, kWindow, kWindowTurn}, limits);
    span.score = found.empty() ? -1 : found.front().score - pyramid.score(query, span.estimated);
    if (!found.empty()) span.required = found.front().map_from_scan;
  }
  std::stable_sort(spans.begin(), spans.end(), [](const Span& a, const Span& b) { return a.score > b.score; });
  std::optional<Span> best;
  for (std::size_t i = 0; i < std::min(kMost, spans.size()) && spans[i].score > 0; ++i) {
    Span& span = spans[i];
    const auto reference = matcher_->prepare(matching::oncePerCell(seenBefore(span, state), kFine / 2));
    const auto query = matching::oncePerCell(seenAfter(span, state), kFine);
    span.match = matcher_->match(*reference, query, span.required);
    // What the matcher leads away from the motion that the map has does not speak for it.
    const auto as_it_is = matcher_->match(*reference, query, span.estimated);
    const bool stays = distanceBetween(as_it_is.reference_from_scan, span.estimated).within(kSameSlip, kSameSlipTurn);
    span.overlap = stays ? as_it_is.overlap : 0;
    if (span.match.degenerate || span.match.overlap < kLeastOverlap || span.match.overlap < span.overlap + kBetter)
      continue;
    if (distanceBetween(span.match.reference_from_scan, span.estimated).within(kSameSlip, kSameSlipTurn)) continue;
    if (!best || span.match.overlap - span.overlap > best->match.overlap - best->overlap) best = span;
  }
  return best;
}

}  // namespace omnimapper::plugins
