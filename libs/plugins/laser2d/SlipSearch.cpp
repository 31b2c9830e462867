#include "SlipSearch.h"

#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/graph/Between.h>
#include <omnimapper/matching/CorrelativeSearch.h>
#include <omnimapper/plugin/PoseFactors.h>

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
constexpr double kSameSlip = 0.3, kSameSlipTurn = 0.1;  // [m] [rad] within which two motions are the same
constexpr double kSlipDegree = base::option_text::kRadiansPerDegree;
constexpr double kMapError = 0.8, kMapAngleError = 8 * kSlipDegree;  // [m] [rad] of the map from a closure to a span

// The planar motion that a factor between two poses measured.
std::optional<TPose2D> measuredBy(const graph::Factor& factor) {
  if (const auto* planar = dynamic_cast<const graph::BetweenSe2*>(&factor)) return geometry::toMrpt(planar->measured());
  if (const auto* spatial = dynamic_cast<const graph::BetweenSe3*>(&factor))
    return geometry::toMrpt(geometry::project(spatial->measured()));
  return std::nullopt;
}

TPose2D inverseOf(const TPose2D& pose) {
  return TPose2D() - pose;
}

// The factors of the odometry between two key frames.
std::vector<base::FactorId> linksBetween(const map::KeyFrame& before, const map::KeyFrame& after,
                                         const graph::Graph& graph) {
  std::vector<base::FactorId> links;
  for (const auto id : graph.factorsOf(after.pose)) {
    const auto& record = graph.factor(id);
    const bool is_link = record.variables == std::vector<base::VariableId>{before.pose, after.pose};
    if (is_link && record.weight > 0 && !record.tags.hypothesis) links.push_back(id);
  }
  return links;
}

}  // namespace

// The span from key frame trajectory_[before] to the next.
struct SlipSearch::Span {
  std::size_t before = 0;
  TPose2D estimated, required;            // the motion in the map, and the one that the closures require
  double as_estimated = 0, as_found = 0;  // share of the scans after it that fit those before it
  TPose2D found;                          // where they fit best, near the required motion
};

// The motion that replaces a measured one.
struct SlipSearch::SpanCorrection {
  Span span;
  mapper::RelativeMotion motion;  // in the plane, with wide variances of height and tilt
  std::string reason;
  std::vector<std::pair<std::string, double>> numbers;
};

SlipSearch::SlipSearch(const LoopClosureOptions& options, const mapper::PluginContext& context,
                       std::shared_ptr<const matching::ScanMatcher> matcher, std::vector<base::FactorId> refused,
                       std::vector<LoopSearch::KeyScan> trajectory)
    : options_(options),
      context_(context),
      matcher_(std::move(matcher)),
      refused_(std::move(refused)),
      trajectory_(std::move(trajectory)) {}

mapper::Batch SlipSearch::operator()(const mapper::State& state) const {
  mapper::Batch batch;
  const auto agreeing = this->agreeing(state);
  if (agreeing.size() < 2) return batch;
  auto candidates = spans(agreeing, state);
  compare(candidates, state);
  mapper::Decision decision(state.map.keyFrame(trajectory_[agreeing.front().newest].frame), context_.section, kSlip);
  decision.to = trajectory_[agreeing.front().place].frame;
  decision.numbers = {{"closures that agree", static_cast<double>(agreeing.size())},
                      {"spans that may have slipped", static_cast<double>(candidates.size())}};
  if (candidates.empty()) {
    decision.kind = "global loop search";
    decision.reason = "the closures confuse places that look alike: no slip of the robot explains them";
    batch.log(std::move(decision));
    return batch;
  }
  auto correction = correctedByScans(candidates, state);
  if (!correction) correction = correctedByClosures(candidates);
  if (!correction) {
    decision.reason = "closures that agree with one another contradict the map, and no single span explains that";
    batch.log(std::move(decision));
    return batch;
  }
  const Span& span = correction->span;
  const auto& before = state.map.keyFrame(trajectory_[span.before].frame);
  const auto& after = state.map.keyFrame(trajectory_[span.before + 1].frame);
  const auto apart = distanceBetween(planar(correction->motion.begin_from_end), span.estimated);
  decision.from = after.id;
  decision.to = before.id;
  decision.stamp = after.stamp;
  decision.numbers.emplace_back(kSlippedBy, apart.metres);
  decision.numbers.emplace_back(kSlippedByAngle, apart.radians / kSlipDegree);
  decision.numbers.insert(decision.numbers.end(), correction->numbers.begin(), correction->numbers.end());
  decision.accepted = true;
  decision.reason = correction->reason;
  for (const auto id : linksBetween(before, after, state.graph)) batch.setWeight(id, 0);
  auto factor = mapper::betweenPoses(context_.motion, before.pose, after.pose,
                                     withHeightAndTilt(correction->motion, before, after, state), context_.section);
  factor.tags.note = kSlip;
  batch.addFactor(std::move(factor));
  batch.log(std::move(decision));
  return batch;
}

// Keeps height and tilt of a spatial map, which the closures do not contradict.
mapper::RelativeMotion SlipSearch::withHeightAndTilt(mapper::RelativeMotion motion, const map::KeyFrame& before,
                                                     const map::KeyFrame& after, const mapper::State& state) {
  const auto known = state.covarianceBetween(before.id, after.id);
  if (!known) return motion;
  const auto estimated = after.map_from_base - before.map_from_base;
  const auto& corrected = motion.begin_from_end;
  motion.begin_from_end = mrpt::poses::CPose3D(corrected.x(), corrected.y(), estimated.z(), planar(corrected).phi,
                                               estimated.pitch(), estimated.roll());
  for (const int i : {2, 3, 4}) motion.covariance(i, i) = (*known)(i, i);
  return motion;
}

TPose2D SlipSearch::motion(std::size_t from, std::size_t to, const mapper::State& state) const {
  return planar(state.map.keyFrame(trajectory_[to].frame).map_from_base -
                state.map.keyFrame(trajectory_[from].frame).map_from_base);
}

std::vector<SlipSearch::Closure> SlipSearch::closures(const mapper::State& state) const {
  std::unordered_map<base::VariableId, std::size_t> index;
  for (std::size_t i = 0; i < trajectory_.size(); ++i) index[state.map.keyFrame(trajectory_[i].frame).pose] = i;
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

// The closures that agree with the newest one, which is included; sorted by their later key frame. Two closures are
// compared over the short spans between their ends, so an error of the map between place and end does not matter.
std::vector<SlipSearch::Closure> SlipSearch::agreeing(const mapper::State& state) const {
  auto all = closures(state);
  if (all.empty()) return all;
  const Closure newest =
      *std::max_element(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.newest < b.newest; });
  const auto between = [&](std::size_t a, std::size_t b) {
    return a == b ? std::optional(Eigen::Matrix<double, 6, 6>(Eigen::Matrix<double, 6, 6>::Zero()))
                  : state.covarianceBetween(trajectory_[std::min(a, b)].frame, trajectory_[std::max(a, b)].frame);
  };
  const auto disagrees = [&](const Closure& one) {
    const bool is_newest = one.newest == newest.newest && one.place == newest.place;
    const auto places = between(one.place, newest.place), ends = between(one.newest, newest.newest);
    if (!places || !ends) return true;
    if (one.newest == newest.newest && !is_newest) return true;  // two of one key frame are not independent
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

// The spans of consecutive key frames, after all places and before all ends, over which a base could have driven the
// required motion.
std::vector<SlipSearch::Span> SlipSearch::spans(const std::vector<Closure>& agreeing,
                                                const mapper::State& state) const {
  constexpr double kMostMotion = 3;  // [m] between consecutive key frames, beyond the estimated motion
  const Closure& first = agreeing.front();
  std::size_t begin = 0;
  for (const auto& closure : agreeing) begin = std::max(begin, closure.place);
  std::vector<Span> all;
  for (std::size_t i = begin; i < first.newest; ++i) {
    const auto& before = state.map.keyFrame(trajectory_[i].frame);
    const auto& after = state.map.keyFrame(trajectory_[i + 1].frame);
    if (linksBetween(before, after, state.graph).empty()) continue;
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

matching::ScanWithNormals SlipSearch::seenBefore(const Span& span, const mapper::State& state) const {
  std::vector<LoopSearch::KeyScan> key_scans;
  for (std::size_t i = span.before + 1; i-- > 0;) {
    if (trajectory_[span.before].travel - trajectory_[i].travel > 2 * options_.context) break;
    key_scans.push_back(trajectory_[i]);
  }
  return localMap(key_scans, trajectory_[span.before].frame, state);
}

matching::ScanWithNormals SlipSearch::seenAfter(const Span& span, const mapper::State& state) const {
  std::vector<LoopSearch::KeyScan> key_scans;
  for (std::size_t i = span.before + 1; i < trajectory_.size(); ++i) {
    if (trajectory_[i].travel - trajectory_[span.before + 1].travel > options_.context) break;
    key_scans.push_back(trajectory_[i]);
  }
  return localMap(key_scans, trajectory_[span.before + 1].frame, state);
}

// Computes how well the scans before and after each span fit at the estimated motion, and at the best one near the
// required motion, because the map between the closures has errors, too.
void SlipSearch::compare(std::vector<Span>& spans, const mapper::State& state) const {
  constexpr double kSpacing = 0.25;  // [m] between the points
  grid::LikelihoodOptions grid;
  grid.cell = 0.1;
  grid.sigma = 0.1;
  matching::SearchOptions limits;
  limits.min_score = 0.3;
  limits.max_results = 1;
  limits.max_blocks = 2000;
  for (auto& span : spans) {
    const grid::LikelihoodPyramid pyramid(seenBefore(span, state).points, grid);
    const auto query = matching::voxelDownsample(seenAfter(span, state), kSpacing).points;
    span.as_estimated = pyramid.score(query, span.estimated);
    const auto found = matching::search(pyramid, query, {span.required, kMapError, kMapError, kMapAngleError}, limits);
    if (found.empty()) continue;
    span.found = found.front().map_from_scan;
    span.as_found = found.front().score;
  }
}

// The span whose scans gain most overlap at the motion that the closures require, by a fine match.
std::optional<SlipSearch::SpanCorrection> SlipSearch::correctedByScans(std::vector<Span> spans,
                                                                       const mapper::State& state) const {
  constexpr double kFine = 0.08;         // [m] between the points
  constexpr double kLeastOverlap = 0.4;  // as laser odometry requires
  constexpr double kBetter = 0.1;        // least gain of overlap over the estimated motion
  constexpr std::size_t kMost = 5;
  const auto gain = [](const Span& span) { return span.as_found - span.as_estimated; };
  std::stable_sort(spans.begin(), spans.end(), [&](const Span& a, const Span& b) { return gain(a) > gain(b); });
  std::optional<SpanCorrection> best;
  double best_gain = kBetter;
  for (std::size_t i = 0; i < std::min(kMost, spans.size()) && gain(spans[i]) > 0; ++i) {
    const Span& span = spans[i];
    const auto reference = matcher_->prepare(matching::voxelDownsample(seenBefore(span, state), kFine / 2));
    const auto query = matching::voxelDownsample(seenAfter(span, state), kFine);
    const auto match = matcher_->match(*reference, query, span.found);
    if (match.degenerate || match.overlap < kLeastOverlap) continue;
    if (distanceBetween(match.reference_from_scan, span.estimated).within(kSameSlip, kSameSlipTurn)) continue;
    // A match that starts at the estimated motion and ends elsewhere does not support that motion.
    const auto as_it_is = matcher_->match(*reference, query, span.estimated);
    const bool stays = distanceBetween(as_it_is.reference_from_scan, span.estimated).within(kSameSlip, kSameSlipTurn);
    const double better = match.overlap - (stays ? as_it_is.overlap : 0);
    if (better <= best_gain) continue;
    best_gain = better;
    best = SpanCorrection{
        span,
        scanMotion(options_, match),
        "closures that agree contradict the motion here, and the scans fit better at the one they require",
        {{"overlap", match.overlap}, {"overlap gained", better}}};
  }
  return best;
}

// The only span whose scans do not confirm its motion, such as one that only the wheels measured. It gets the motion
// that follows from the closures, with a fixed uncertainty for the error of the rest of the map.
std::optional<SlipSearch::SpanCorrection> SlipSearch::correctedByClosures(std::vector<Span> spans) {
  constexpr double kMost = 0.2;  // share of the scans that may fit by chance
  if (spans.empty()) return std::nullopt;
  std::stable_sort(spans.begin(), spans.end(),
                   [](const Span& a, const Span& b) { return a.as_estimated < b.as_estimated; });
  const Span& worst = spans[0];
  if (worst.as_estimated > kMost || (spans.size() > 1 && spans[1].as_estimated < worst.as_estimated + kMost / 2))
    return std::nullopt;
  const Eigen::Vector3d sigmas(kMapError, kMapError, kMapAngleError);
  return SpanCorrection{worst,
                        planarMotion(worst.required, sigmas.cwiseAbs2().asDiagonal()),
                        "closures that agree contradict the motion here, which no scans confirm",
                        {{"share of the scans that fitted [1]", worst.as_estimated}}};
}

}  // namespace omnimapper::plugins
