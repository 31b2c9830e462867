#pragma once

#include <mrpt/obs/CObservationBearingRange.h>
#include <omnimapper/graph/PointFactor.h>
#include <omnimapper/landmarks/Fit.h>
#include <omnimapper/landmarks/LandmarkAssociator.h>
#include <omnimapper/landmarks/LandmarkIndex.h>
#include <omnimapper/landmarks/LandmarkMerging.h>
#include <omnimapper/landmarks/LandmarkPlugin.h>
#include <omnimapper/testing/HandMadeRun.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

// The simplest landmarks with a life cycle: dots on the floor, whose positions are measured.
namespace omnimapper::landmarks {

constexpr double kDotSigma = 0.1;  // [m]

struct Dot {
  Eigen::Vector2d in_base;
  int number = -1;  // -1: the sensor does not tell dots apart
  bool is_useless = false;
};

struct DotPayload : map::LandmarkPayload {
  DotPayload(int number, int measurements) : number(number), measurements(measurements) {}

  std::string_view kind() const override { return "dot"; }
  void write(std::ostream& /*out*/) const override {}
  std::shared_ptr<const DotPayload> with(const DotPayload& other) const {
    return std::make_shared<DotPayload>(number, measurements + other.measurements);
  }

  const int number, measurements;
};

struct KnownDot : KnownLandmark {
  int number = -1;

  void refresh(const map::Landmark& landmark, const mapper::View& view) {
    KnownLandmark::refresh(landmark, view);
    number = dynamic_cast<const DotPayload&>(*landmark.payload).number;
  }
};

struct DotOptions : mapper::AssociationOptions {
  bool are_pairs_one = false;  // a measurement between two dots is of either
  mapper::Repeats repeats = mapper::Repeats::no;
};

class DotAssociator : public LandmarkAssociator<Dot> {
 public:
  DotAssociator(const DotOptions& options, const LandmarkIndex<KnownDot>& known, const map::KeyFrame& frame,
                const mapper::View& view)
      : LandmarkAssociator(options, known.owner(), frame, view, options.repeats), options_(options), known_(known) {}

 protected:
  void describe(const Dot& dot, mapper::Decision& decision) const override {
    decision.kind = "dot";
    decision.numbers.emplace_back("x [m]", dot.in_base.x());
  }
  std::string whyUseless(const Dot& dot) const override { return dot.is_useless ? "blurred" : ""; }
  bool isIdentified(const Dot& dot) const override { return dot.number >= 0; }
  std::vector<base::LandmarkId> candidates(const Dot& dot) override {
    std::vector<base::LandmarkId> all;
    for (const auto& [id, known] : known_.all())
      if (!isIdentified(dot) || known.number == dot.number) all.push_back(id);
    return all;
  }
  graph::FactorRecord record(const Dot& dot, base::VariableId variable) const override {
    return {{frame().pose, variable},
            std::make_shared<graph::PointFactor2>(dot.in_base),
            graph::SquareRootInformation::fromSigmas(Eigen::Vector2d::Constant(kDotSigma))};
  }
  std::string whyEither(base::LandmarkId /*a*/, base::LandmarkId /*b*/) const override {
    return options_.are_pairs_one ? "they are a pair" : "";
  }
  std::shared_ptr<const map::LandmarkPayload> learned(const Dot& /*dot*/, const LandmarkIds& known) override {
    const auto& payload = payloadOf<DotPayload>(known.landmark);
    return payload.with(DotPayload(payload.number, 1));
  }
  void addNew(const Dot& dot, mapper::Decision decision) override {
    const auto map_from_base = mapper::poseOf(view().graph, frame().pose);
    const auto in_map = map_from_base.composePoint({dot.in_base.x(), dot.in_base.y(), 0});
    addLandmark(
        dot, std::move(decision),
        {"dot", graph::point2(), Eigen::Vector2d(in_map.x, in_map.y), std::make_shared<DotPayload>(dot.number, 1)});
  }

 private:
  const DotOptions& options_;
  const LandmarkIndex<KnownDot>& known_;
};

struct PreparedDots : mapper::Prepared {
  std::vector<Dot> dots;
};

class DotPlugin : public LandmarkPlugin<LandmarkIndex<KnownDot>> {
 public:
  explicit DotPlugin(DotOptions options = {}) : LandmarkPlugin(LandmarkIndex<KnownDot>("dots")), options_(options) {}

  bool wants(const mrpt::obs::CObservation& /*observation*/) const override { return true; }
  const LandmarkIndex<KnownDot>& index() const { return known(); }

 protected:
  mapper::Batch associate(const map::KeyFrame& frame, const mapper::Observed& observed,
                          const mapper::View& view) override {
    return DotAssociator(options_, known(), frame, view)
        .take(dynamic_cast<const PreparedDots&>(*observed.prepared).dots);
  }
  mapper::Batch merge(const mapper::View& view) override {
    constexpr double kLimit = 13.8;  // 99.9 %, two rows
    LandmarkMerging<DotPayload> merging(view, known().owner());
    const auto& all = known().all();
    for (auto a = all.begin(); a != all.end(); ++a) {
      for (auto b = std::next(a); b != all.end(); ++b) {
        if (!merging.mayMerge(a->first, b->first)) continue;
        const auto fit = fitOfGap(a->second.variable, b->second.variable, view);
        if (fit && fit->chi2 <= kLimit) merging.merge(a->first, b->first, {fit->chi2, kLimit, ""});
      }
    }
    return merging.take();
  }

 private:
  DotOptions options_;
};

/// A run with one plugin of dots, which a test drives by hand. All poses are exact, unless a test frees them.
struct DotRun : testing::HandMadeRun {
  DotPlugin plugin;

  explicit DotRun(DotOptions options = {}) : plugin(options) { map.sessions.push_back({0, "first", {}, true}); }

  /// The decisions about dots that are seen from a new key frame there.
  mapper::DecisionLog see(const std::vector<Dot>& dots, double x = 0) {
    const auto frame = addFrame({x, 0, 0, 0, 0, 0});
    graph.setFixed(frame.pose, true);
    return seeFrom(frame, dots);
  }
  mapper::DecisionLog seeFrom(const map::KeyFrame& frame, const std::vector<Dot>& dots) {
    uncertainty = mapper::Uncertainty(graph);
    PreparedDots prepared;
    prepared.dots = dots;
    const mrpt::obs::CObservationBearingRange observation;
    return applied(plugin.measure(frame, {observation, &prepared}, view()), frame.stamp);
  }
  mapper::DecisionLog applied(const mapper::Batch& batch, base::Stamp stamp) {
    plugin.applied(mapper::apply(batch, {"dots", stamp}, graph, map));
    return batch.decisions();
  }
  mapper::DecisionLog finish() {
    uncertainty = mapper::Uncertainty(graph);
    return applied(plugin.atEnd(view()), map.key_frames.back().stamp);
  }
  const map::Landmark& landmark(std::uint32_t index) const { return map.landmark({0, index}); }
  int measurementsOf(std::uint32_t index) const {
    return dynamic_cast<const DotPayload&>(*landmark(index).payload).measurements;
  }
};

}  // namespace omnimapper::landmarks
