#include "SignClosures.h"

#include <omnimapper/graph/ChiSquare.h>
#include <omnimapper/graph/PointFactor.h>
#include <omnimapper/landmarks/Fit.h>
#include <omnimapper/landmarks/LandmarkMerging.h>

#include <algorithm>
#include <optional>
#include <set>
#include <utility>
#include <vector>

namespace omnimapper::plugins {

namespace {

using graph::SamePointFactor;

// [m] Largest distance between two estimates of one sign if the texts agree, whatever the covariance allows.
constexpr double kOfOneSign = 1;
// [m] The same if the texts agree only partly: a number and words on one plate.
constexpr double kOfOnePlate = 0.25;

// The hypothesis that two signs are the same, if it was proposed.
std::optional<base::FactorId> hypothesisOf(base::VariableId a, base::VariableId b, const mapper::View& view) {
  for (const auto id : view.graph.factorsOf(a)) {
    const auto& record = view.graph.factor(id);
    if (record.tags.hypothesis && record.factor->kind() == SamePointFactor::kKind &&
        std::count(record.variables.begin(), record.variables.end(), b) > 0)
      return id;
  }
  return std::nullopt;
}

class Proposals {
 public:
  Proposals(SignTracks& tracks, const SignLandmarksOptions& options, const std::string& section,
            const mapper::View& view)
      : tracks_(tracks), options_(options), section_(section), view_(view) {}

  mapper::Batch of(const std::vector<base::LandmarkId>& fresh) {
    for (const auto id : fresh)
      if (tracks_.all().count(id) > 0) look(id);
    for (const auto id : repeated_) {
      if (!signOf(view_, id).is_repeated) batch_.describeLandmark(id, signOf(view_, id).repeated());
    }
    return std::move(batch_);
  }

 private:
  void look(base::LandmarkId id) {
    const auto& own = tracks_.all().at(id);
    const SignText text = signOf(view_, id).text();
    std::vector<base::LandmarkId> others;
    bool is_repeated = false;
    for (const auto& [other, known] : tracks_.all()) {
      if (other == id || agreementOf(text, signOf(view_, other).text()) != Agreement::agrees) continue;
      is_repeated = is_repeated || signOf(view_, other).is_repeated;
      if (id < other) continue;
      if (tracks_.isRecent(known, options_.recent_travel) && view_.areAligned(id.session, other.session)) {
        // Both were seen recently: if they are far from each other, they are two signs with the same text.
        const bool is_far = (view_.graph.value(own.variable) - view_.graph.value(known.variable)).norm() > kOfOneSign;
        if (is_far) repeated_.insert(other);
        is_repeated = is_repeated || is_far;
      } else if (!isOneOf(others, other)) {
        others.push_back(other);
      }
    }
    if (others.size() > 1 || is_repeated) {
      repeated_.insert(id);
      repeated_.insert(others.begin(), others.end());
      return;
    }
    if (others.empty()) return;
    graph::FactorRecord record{
        {tracks_.all().at(others.front()).variable, own.variable},
        std::make_shared<SamePointFactor>(oddsOfOneSign(text, signOf(view_, others.front()).text())),
        graph::SquareRootInformation::fromSigmas(Eigen::Vector3d::Constant(options_.same_sigma))};
    record.tags.owner = section_;
    record.tags.landmark = id;
    record.tags.note = "same sign " + signOf(view_, id).title();
    mapper::Decision decision;
    decision.stamp = view_.map.landmark(id).last_seen;
    decision.plugin = section_;
    decision.kind = "same sign";
    decision.reason = "waits for the consistency test";
    decision.from = view_.map.key_frames.back().id;
    decision.is_loop_closure = true;
    decision.to = keyFrameOf(others.front());
    decision.numbers.emplace_back("landmark", others.front().index);
    batch_.addHypothesis(std::move(record), std::move(decision));
  }

  // The key frame from which the sign was read best.
  std::optional<base::KeyFrameId> keyFrameOf(base::LandmarkId id) const {
    const auto& look = signOf(view_, id).best_look;
    if (!look || !view_.map.key_frames.find(look->frame)) return std::nullopt;
    return look->frame;
  }

  bool isOneOf(const std::vector<base::LandmarkId>& others, base::LandmarkId id) const {
    return std::any_of(others.begin(), others.end(), [&](auto other) { return areOne(other, id); });
  }

  // Whether an accepted hypothesis says that they are the same sign; such signs are merged at the end.
  bool areOne(base::LandmarkId a, base::LandmarkId b) const {
    const auto hypothesis = hypothesisOf(tracks_.all().at(a).variable, tracks_.all().at(b).variable, view_);
    return hypothesis && view_.graph.factor(*hypothesis).weight > 0;
  }

  SignTracks& tracks_;
  const SignLandmarksOptions& options_;
  const std::string& section_;
  const mapper::View& view_;
  std::set<base::LandmarkId> repeated_;
  mapper::Batch batch_;
};

}  // namespace

mapper::Batch proposeSameSigns(SignTracks& tracks, const SignLandmarksOptions& options, const std::string& section,
                               const mapper::View& view) {
  return Proposals(tracks, options, section, view).of(std::exchange(tracks.fresh, {}));
}

mapper::Batch mergeSameSigns(const SignTracks& tracks, const SignLandmarksOptions& options, const std::string& section,
                             const mapper::View& view) {
  const double limit = graph::chiSquareQuantile(options.confidence, 3) * options.inflation * options.inflation;
  landmarks::LandmarkMerging<SignPayload> merging(view, section);
  for (auto a = tracks.all().begin(); a != tracks.all().end(); ++a) {
    for (auto b = std::next(a); b != tracks.all().end(); ++b) {
      if (!merging.mayMerge(a->first, b->first)) continue;
      const SignText text = merging.payloadOf(a->first).text(), other = signOf(view, b->first).text();
      const auto agreement = agreementOf(text, other);
      const bool is_misread = agreement == Agreement::contradicts && mayBeMisread(text, other);
      const auto hypothesis = hypothesisOf(a->second.variable, b->second.variable, view);
      const bool is_accepted = hypothesis && !is_misread && view.graph.factor(*hypothesis).weight > 0;
      if (agreement == Agreement::contradicts && hypothesis)
        merging.batch().removeFactor(*hypothesis);  // the texts were read differently since
      if (agreement == Agreement::contradicts && !is_misread) continue;
      const double most = agreement == Agreement::agrees ? kOfOneSign : kOfOnePlate;
      const auto gap = view.graph.value(b->second.variable) - view.graph.value(a->second.variable);
      if (!is_accepted && gap.norm() > most) continue;
      const auto fit = landmarks::fitOfGap(a->second.variable, b->second.variable, view, options.same_sigma);
      if (!is_accepted && (!fit || fit->chi2 > limit)) continue;
      merging.merge(a->first, b->first, {fit ? fit->chi2 : 0, limit, ""});
    }
  }
  return merging.take();
}

}  // namespace omnimapper::plugins
