#include <omnimapper/mapper/EngineOptions.h>

namespace omnimapper::mapper {

const base::OptionTable<EngineOptions>& EngineOptions::table() {
  using Options = EngineOptions;
  static const auto table =
      base::OptionTable<Options>()
          .choice("motion", &Options::motion, {{"planar", Motion::planar}, {"spatial", Motion::spatial}},
                  "Motion of the base: planar on a floor, or spatial with six degrees of freedom.")
          .list("pose_plugins", &Options::pose_plugins,
                "INI sections of the pose plugins, which measure the motion between two times, such as odometry.")
          .list("measurement_plugins", &Options::measurement_plugins,
                "INI sections of the measurement plugins, in processing order: a pose measured by one plugin is "
                "available to those after it.")
          .list("output_plugins", &Options::output_plugins, "INI sections of the output plugins.")
          .list("sensors", &Options::sensors, "INI sections that give the pose of a sensor on the base.")
          .list("plugin_libraries", &Options::plugin_libraries, "Shared libraries that contain further plugin classes.")
          .text("reference_sensor", &Options::reference_sensor,
                "Label of the sensor whose observations each get a line in the trajectory; empty for the first "
                "sensor that triggers a key frame.")
          .number("window_s", &Options::window, base::Range::notNegative(),
                  "Time for which observations wait for slower sensors before they are processed.")
          .number("horizon_s", &Options::horizon, base::Range::notNegative(),
                  "Largest age up to which observations that come later than window_s are still placed in the "
                  "trajectory; older ones are rejected.")
          .integer("queue_limit", &Options::queue_limit, base::Range{1, 1e9},
                   "Largest number of stamps that wait in the queue. If more wait, the oldest is processed before "
                   "window_s is over, so that a sensor whose stamps hardly advance cannot fill the memory.")
          .integer("job_delay", &Options::job_delay, base::Range{0, 1e6},
                   "Number of key frames after which the result of a job, such as a loop closure search, is "
                   "applied, counted from the key frame that started it.")
          .integer("solve_every", &Options::solve_every, base::Range{1, 1e9},
                   "Number of new key frames after which the graph is solved.")
          .integer("solve_after_closure", &Options::solve_after_closure, base::Range{1, 1e9},
                   "Smallest number of key frames since the last solve at which a loop closure triggers another "
                   "solve.")
          .number("solve_growth", &Options::solve_growth, base::Range{0, 1},
                  "Smallest number of key frames between solves as a share of all key frames, so that the cost per "
                  "key frame does not grow with the map. A quarter of it suffices where a closure contradicts the "
                  "estimate.")
          .number("cloud_voxel_m", &Options::cloud_voxel, base::Range{0, 10},
                  "Side of the cubes in each of which the map keeps one coloured point of the depth images; 0 keeps "
                  "none.")
          .number("cloud_max_range_m", &Options::cloud_max_range, base::Range::positive(),
                  "Largest distance from the camera of the coloured points that the map keeps of the depth images.");
  return table;
}

const base::OptionTable<HypothesisOptions>& HypothesisOptions::table() {
  using Options = HypothesisOptions;
  using Method = graph::ConsistencyOptions::Method;
  static const auto table =
      base::OptionTable<Options>()
          .choice("test", &Options::test,
                  {{"none", Method::none}, {"pairwise", Method::pairwise}, {"graduated", Method::graduated}},
                  "Consistency test of loop closures and other hypotheses: none accepts all; pairwise accepts one "
                  "after the other, the most certain first; graduated weighs all together and lowers the weights of "
                  "outliers (graduated non-convexity).")
          .number("confidence", &Options::confidence, base::Range{0.5, 0.999999999},
                  "Probability with which a true hypothesis passes a gate.")
          .number("min_likelihood_ratio", &Options::min_likelihood_ratio, base::Range{1, 1e12},
                  "A hypothesis is accepted by itself only if its measurement is at least this many times likelier "
                  "than if the hypothesis were false and its measurement lay anywhere in the map. Otherwise it waits "
                  "until another hypothesis confirms it; with 1 it never waits.")
          .number("inflation", &Options::inflation, base::Range{1, 100},
                  "Factor on the standard deviations that the map predicts, in the consistency test alone, because "
                  "odometry and laser odometry are overconfident.");
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
                                                                        "INI sections of the extractors, in "
                                                                        "processing order.");
  return table;
}

const base::OptionTable<SolverOptions>& SolverOptions::table() {
  using Options = SolverOptions;
  using Method = graph::SolveOptions::Method;
  static const auto table =
      base::OptionTable<Options>()
          .choice("method", &Options::method,
                  {{"levenberg_marquardt", Method::levenberg_marquardt}, {"dogleg", Method::dogleg}},
                  "Optimization method by which the graph is solved.")
          .integer("max_iterations", &Options::max_iterations, base::Range{1, 1e6},
                   "Largest number of iterations of a solve while the map grows.")
          .number("tolerance", &Options::tolerance, base::Range{0, 1},
                  "While the map grows, a solve ends after a step that lowers the cost by less than this share of it.")
          .integer("final_max_iterations", &Options::final_max_iterations, base::Range{1, 1e6},
                   "Largest number of iterations of the last solve.")
          .number("final_tolerance", &Options::final_tolerance, base::Range{0, 1},
                  "The last solve ends after a step that lowers the cost by less than this share of it.");
  return table;
}

}  // namespace omnimapper::mapper
