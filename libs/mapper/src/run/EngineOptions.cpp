#include <omnimapper/mapper/EngineOptions.h>

namespace omnimapper::mapper {

const base::OptionTable<EngineOptions>& EngineOptions::table() {
  using Options = EngineOptions;
  static const auto table =
      base::OptionTable<Options>()
          .choice("motion", &Options::motion, {{"planar", Motion::planar}, {"spatial", Motion::spatial}},
                  "How the base moves: on a floor, or freely.")
          .list("pose_plugins", &Options::pose_plugins, "Sections of the continuous pose sources.")
          .list("measurement_plugins", &Options::measurement_plugins,
                "Sections of the measurement plugins, in order: a measured pose serves those after it.")
          .list("output_plugins", &Options::output_plugins, "Sections of the outputs.")
          .list("sensors", &Options::sensors, "Sections that tell where a sensor is on the base.")
          .list("plugin_libraries", &Options::plugin_libraries, "Shared libraries with further plugin classes.")
          .text("reference_sensor", &Options::reference_sensor,
                "Label of the sensor whose every observation gets a line in the trajectory; empty for the first that "
                "earns a key frame.")
          .number("window_s", &Options::window, base::Range::notNegative(),
                  "Observations wait so long for slower sensors before they are worked on.")
          .number("horizon_s", &Options::horizon, base::Range::notNegative(),
                  "Observations later than window_s still get their place in the trajectory if they are not older than "
                  "this; what is older is refused.")
          .integer("queue_limit", &Options::queue_limit, base::Range{1, 1e9},
                   "So many stamps wait at most, whatever window_s says: a clock that stands still must not fill the "
                   "memory.")
          .integer("job_delay", &Options::job_delay, base::Range{0, 1e6},
                   "What a job finds, such as a loop closure, counts so many key frames after the one that asked.")
          .integer("solve_every", &Options::solve_every, base::Range{1, 1e9}, "Solve after so many key frames.")
          .integer("solve_after_closure", &Options::solve_after_closure, base::Range{1, 1e9},
                   "Solve after a loop closure, but not before so many key frames have passed since the last solve.")
          .number("solve_growth", &Options::solve_growth, base::Range{0, 1},
                  "Solves are at least this share of the key frames apart, a quarter of it where a closure contradicts "
                  "the estimate: a solve costs as much as the map is large, a key frame is to cost the same always.")
          .number("cloud_voxel_m", &Options::cloud_voxel, base::Range{0, 10},
                  "Of depth images the map keeps one coloured point in each cube of this side; 0: none.")
          .number("cloud_max_range_m", &Options::cloud_max_range, base::Range::positive(),
                  "Points of that cloud are at most so far from the camera.");
  return table;
}

const base::OptionTable<HypothesisOptions>& HypothesisOptions::table() {
  using Options = HypothesisOptions;
  using Method = graph::ConsistencyOptions::Method;
  static const auto table =
      base::OptionTable<Options>()
          .choice("test", &Options::test,
                  {{"none", Method::none}, {"pairwise", Method::pairwise}, {"graduated", Method::graduated}},
                  "How loop closures and other hypotheses are tested: not at all, pair by pair for the largest set "
                  "that agrees, or by graduated non-convexity.")
          .number("confidence", &Options::confidence, base::Range{0.5, 0.999999999},
                  "A true hypothesis passes a gate with this probability.")
          .number("min_likelihood_ratio", &Options::min_likelihood_ratio, base::Range{1, 1e12},
                  "A hypothesis acts when what it measures is so many times likelier if it is true than if it lies "
                  "anywhere in the map; else it waits for another that bears it out. 1 lets a lone one in.")
          .number("inflation", &Options::inflation, base::Range{1, 100},
                  "Factor on the standard deviations of the trajectory: odometry and laser odometry are surer of "
                  "themselves than they should be.");
  return table;
}

EngineSettings EngineSettings::read(const base::Config& config) {
  EngineSettings settings;
  settings.engine = config.section("mapper").read<EngineOptions>();
  settings.trigger = config.section("trigger").read<TriggerOptions>();
  settings.solver = config.section("solver").read<SolverOptions>();
  settings.hypotheses = config.section("hypotheses").read<HypothesisOptions>();
  return settings;
}

const base::OptionTable<PerceptionOptions>& PerceptionOptions::table() {
  static const auto table = base::OptionTable<PerceptionOptions>().list("extractors", &PerceptionOptions::extractors,
                                                                        "Sections of the extractors, in order.");
  return table;
}

const base::OptionTable<SolverOptions>& SolverOptions::table() {
  using Options = SolverOptions;
  using Method = graph::SolveOptions::Method;
  static const auto table =
      base::OptionTable<Options>()
          .choice("method", &Options::method,
                  {{"levenberg_marquardt", Method::levenberg_marquardt}, {"dogleg", Method::dogleg}},
                  "How the graph is solved.")
          .integer("max_iterations", &Options::max_iterations, base::Range{1, 1e6},
                   "Iterations at most of a solve while the map grows.")
          .number("tolerance", &Options::tolerance, base::Range{0, 1},
                  "A solve while the map grows ends when a step lowers the cost by less than this part.")
          .integer("final_max_iterations", &Options::final_max_iterations, base::Range{1, 1e6},
                   "Iterations at most of the last solve.")
          .number("final_tolerance", &Options::final_tolerance, base::Range{0, 1},
                  "The last solve ends when a step lowers the cost by less than this part.");
  return table;
}

}  // namespace omnimapper::mapper
