// How false loop closures affect the map of a whole log. A plugin of this benchmark proposes false closures in addition
// to those of scan matching, and the error of the map is compared with that of the same log without them.
//
// A false closure states that two key frames that are far apart in time are at the same place, as in the experiments of
// Vertigo (Suenderhauf and Protzel, IROS 2012). They are random ones, or groups of ten in a row that agree with one
// another.
//
// Example: bench-false_closures_logs -i ini/laser2d.ini -r aces.rawlog --relations aces.relations -o out/false
#include <mrpt/poses/CPose2D.h>
#include <omnimapper/base/Progress.h>
#include <omnimapper/eval/AbsoluteTrajectoryError.h>
#include <omnimapper/eval/RelationError.h>
#include <omnimapper/eval/TumFile.h>
#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/graph/Between.h>
#include <omnimapper/graph/GraphArchive.h>
#include <omnimapper/map/MapFile.h>
#include <omnimapper/mapper/Features.h>
#include <omnimapper/mapper/MappingRun.h>
#include <omnimapper/mapper/PluginRegistry.h>
#include <omnimapper/plugin/FactoryOf.h>
#include <omnimapper/plugin/PoseFactors.h>
#include <omnimapper/testing/SimulatedLog.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <map>
#include <sstream>

namespace bench {

using namespace omnimapper;

struct FalseClosureOptions {
  double per_key_frame = 0;
  int group = 1;
  int seed = 1;

  static const base::OptionTable<FalseClosureOptions>& table() {
    using Options = FalseClosureOptions;
    static const auto table =
        base::OptionTable<Options>()
            .number("per_key_frame", &Options::per_key_frame, base::Range{0, 10}, "False closures per key frame.")
            .integer("group", &Options::group, base::Range{1, 100},
                     "Number of false closures in a row that agree with one another.")
            .integer("seed", &Options::seed, base::Range{0, 1e9}, "Seed of the random numbers.");
    return table;
  }
};

// Proposes groups of false closures that begin at random key frames. Within a group the key frame to which the closure
// leads advances by one with each new key frame.
class FalseClosures : public mapper::MeasurementPlugin {
 public:
  static constexpr const char* kName = "FalseClosures";
  static constexpr const char* kSummary = "Proposes false loop closures.";

  FalseClosures(const FalseClosureOptions& options, const mapper::PluginContext& context)
      : options_(options), context_(context), dice_(static_cast<std::uint64_t>(options.seed)) {}
  bool wants(const mrpt::obs::CObservation&) const override { return false; }
  mapper::Batch measure(const map::KeyFrame&, const mapper::Observed&, const mapper::View&) override { return {}; }

  mapper::FollowUp afterCommit(const map::KeyFrame& frame, const mapper::View& view) override {
    constexpr std::size_t kMinSeparation = 30;  // [key frames]
    mapper::FollowUp follow_up;
    const auto& frames = view.map.key_frames;
    const std::size_t now = frames.position(frame.id);
    if (left_ == 0 && now > 2 * kMinSeparation && dice_.uniform(0, 1) < options_.per_key_frame / options_.group) {
      left_ = options_.group;
      place_ = static_cast<std::size_t>(dice_.uniform(0, static_cast<double>(now - kMinSeparation)));
      offset_ = mrpt::poses::CPose3D(dice_.normal(0.3), dice_.normal(0.3), 0, dice_.normal(0.17), 0, 0);
      first_ = now;
    }
    if (left_ == 0) return follow_up;
    --left_;
    const auto& place = frames[std::min(place_ + (now - first_), now - 1)];
    mapper::RelativeMotion motion{offset_, Eigen::Matrix<double, 6, 6>::Zero()};
    motion.covariance.diagonal() << 4e-4, 4e-4, 1, 0.25, 0.25, 1e-4;
    mapper::Decision decision(frame, context_.section, "false closure");
    decision.to = place.id;
    follow_up.batch.addHypothesis(
        mapper::betweenPoses(context_.motion, place.pose, frame.pose, motion, context_.section), decision);
    return follow_up;
  }

 private:
  FalseClosureOptions options_;
  mapper::PluginContext context_;
  testing::Dice dice_;
  int left_ = 0;
  std::size_t place_ = 0, first_ = 0;
  mrpt::poses::CPose3D offset_;
};

struct Request {
  std::string ini, log, relations, reference, out;
  std::vector<std::string> settings;
  int seeds = 5;
};

struct Outcome {
  double error = 0;  // [m]
  std::size_t true_ones = 0, true_refused = 0, false_ones = 0, false_accepted = 0, closures = 0;
  std::map<base::Stamp, mrpt::poses::CPose3D> poses;
};

// Counts closures. One of scan matching is right if it agrees with the map that was made without false closures.
void judge(const std::string& folder, const std::map<base::Stamp, mrpt::poses::CPose3D>& clean, Outcome& outcome) {
  const auto file = map::MapFile::read(folder + "/map.omnimap");
  const auto frames = map::framesFromSection(*file.find("frames"));
  std::istringstream bytes(file.find("graph")->bytes);
  const auto graph = graph::readGraph(bytes, mapper::registeredKinds().factors);
  std::map<base::VariableId, base::Stamp> stamps;
  for (const auto& frame : frames.key_frames) {
    stamps[frame.pose] = frame.stamp;
    outcome.poses[frame.stamp] = frame.map_from_base;
  }
  const auto& truth = clean.empty() ? outcome.poses : clean;
  for (const auto& [id, record] : graph.factors()) {
    if (!record.tags.hypothesis) continue;
    outcome.closures += record.weight > 0;
    if (record.tags.owner == "false_closures") {
      ++outcome.false_ones;
      outcome.false_accepted += record.weight > 0;
      continue;
    }
    const auto from = truth.find(stamps[record.variables[0]]), to = truth.find(stamps[record.variables[1]]);
    if (from == truth.end() || to == truth.end()) continue;
    const auto expected = geometry::project(geometry::fromMrpt(to->second - from->second));
    const auto error = geometry::minus(dynamic_cast<const graph::BetweenSe2&>(*record.factor).measured(), expected);
    if (error.head<2>().norm() > 0.25 || std::abs(error.z()) > 3 * geometry::kPi / 180) continue;
    ++outcome.true_ones;
    outcome.true_refused += record.weight == 0;
  }
}

Outcome run(const Request& request, double per_key_frame, int group, int seed,
            const std::map<base::Stamp, mrpt::poses::CPose3D>& clean) {
  auto config = base::Config::fromFile(request.ini);
  for (const auto& setting : request.settings) config.set(setting);
  if (per_key_frame > 0) {
    config.set("mapper.measurement_plugins=loop_closure, false_closures");
    config.set("false_closures.class=FalseClosures");
    config.set("false_closures.per_key_frame=" + std::to_string(per_key_frame));
    config.set("false_closures.group=" + std::to_string(group));
    config.set("false_closures.seed=" + std::to_string(seed));
  }
  config.set("mapper.output_plugins=trajectory, map");
  mapper::RunRequest run;
  run.logs = {request.log};
  run.output_folder = request.out;
  base::Progress quiet;
  mapper::runMapping(run, config, quiet, [] { return false; });
  Outcome outcome;
  judge(request.out, clean, outcome);
  const auto trajectory = eval::readTrajectory(request.out + "/trajectory.tum");
  if (!request.relations.empty()) {
    outcome.error = eval::relationError(trajectory, eval::readRelations(request.relations)).translation.mean;
  } else {
    eval::PairingOptions pairing;
    pairing.alignment = eval::Alignment::yaw;
    outcome.error =
        eval::absoluteTrajectoryError(trajectory, eval::readTrajectory(request.reference), pairing).translation.rmse;
  }
  return outcome;
}

int main(const Request& request) {
  const Outcome clean = run(request, 0, 1, 0, {});
  const double key_frames = static_cast<double>(clean.poses.size());
  std::printf("clean: error %.4f m, %zu closures, %zu of %zu right ones refused\n\n", clean.error, clean.closures,
              clean.true_refused, clean.true_ones);
  std::printf(
      "| false per right | in a row | error / clean, mean | worst | right ones refused | false accepted |\n"
      "|---|---|---|---|---|---|\n");
  for (const int group : {1, 10}) {
    for (const double share : {0.01, 0.1, 0.5}) {
      double sum = 0, worst = 0;
      Outcome all;
      for (int seed = 1; seed <= request.seeds; ++seed) {
        const double rate = share * static_cast<double>(clean.true_ones) / key_frames;
        const auto one = run(request, rate, group, seed, clean.poses);
        sum += one.error / clean.error;
        worst = std::max(worst, one.error / clean.error);
        all.true_ones += one.true_ones;
        all.true_refused += one.true_refused;
        all.false_ones += one.false_ones;
        all.false_accepted += one.false_accepted;
      }
      std::printf("| %.0f %% | %d | %.3f | %.3f | %.1f %% | %zu of %zu |\n", 100 * share, group, sum / request.seeds,
                  worst, 100.0 * static_cast<double>(all.true_refused) / static_cast<double>(all.true_ones),
                  all.false_accepted, all.false_ones);
      std::fflush(stdout);
    }
  }
  return 0;
}

}  // namespace bench

int main(int argc, char** argv) {
  bench::Request request;
  CLI::App app("Maps a log with false loop closures among the true ones, and reports how they affect the map.");
  app.add_option("-i,--ini", request.ini)->required();
  app.add_option("-r,--rawlog", request.log)->required();
  app.add_option("--relations", request.relations, "file of relations that were checked by hand");
  app.add_option("--reference", request.reference, "reference trajectory, used if there are no relations");
  app.add_option("-o,--output", request.out)->required();
  app.add_option("--seeds", request.seeds, "runs per row");
  app.add_option("--set", request.settings, "section.key=value");
  CLI11_PARSE(app, argc, argv);
  omnimapper::mapper::loadFeatures();
  omnimapper::mapper::FactoryOf<bench::FalseClosures, bench::FalseClosureOptions>::registerClass();
  return bench::main(request);
}
