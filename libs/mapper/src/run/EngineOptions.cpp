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
                "available to the plugins after it.")
          .list("default_plugins", &Options::default_plugins,
                "Classes of measurement plugins that every run has, before those of measurement_plugins, unless one of "
                "these is of the same class. Their sections have the names of their classes and may be missing.")
          .list("output_plugins", &Options::output_plugins, "INI sections of the output plugins.")
          .list("sensors", &Options::sensors, "INI sections that each give the pose of one sensor on the robot's base.")
          .list("plugin_libraries", &Options::plugin_libraries, "Shared libraries that contain further plugin classes.")
          .text("reference_sensor", &Options::reference_sensor,
                "Label of the reference sensor, whose observations each get a line in the trajectory. Empty for the "
                "first sensor that triggers a key frame.")
          .number("window_s", &Options::window, base::Range::notNegative(),
                  "Time for which observations wait for slower sensors before they are processed.")
          .number("horizon_s", &Options::horizon, base::Range::notNegative(),
                  "An observation that comes later than window_s allows is still placed in the trajectory if its stamp "
                  "is at most this much older than the newest pose; older observations are rejected.")
          .integer("queue_limit", &Options::queue_limit, base::Range{1, 1e9},
                   "Largest number of different stamps whose observations wait in the queue. If more wait, the oldest "
                   "observations are processed before window_s is over, so that a sensor whose stamps hardly advance "
                   "cannot fill the memory.")
          .integer("job_delay", &Options::job_delay, base::Range{0, 1e6},
                   "The result of a job, such as a search for loop closures, is applied this many key frames after the "
                   "key frame that started the job.")
          .integer("solve_every", &Options::solve_every, base::Range{1, 1e9},
                   "The graph is solved after this many new key frames, even without a loop closure, but not before "
                   "solve_growth allows it.")
          .integer("solve_after_closure", &Options::solve_after_closure, base::Range{1, 1e9},
                   "After a loop closure, the graph is solved as soon as this many key frames were made since the last "
                   "solve, but not before solve_growth allows it.")
          .number("solve_growth", &Options::solve_growth, base::Range{0, 1},
                  "Smallest number of key frames between two solves, as a share of all key frames, so that the cost "
                  "per key frame does not grow with the map. A quarter of this number suffices if a loop closure "
                  "contradicts the estimate.")
          .number("cloud_voxel_m", &Options::cloud_voxel, base::Range{0, 10},
                  "Side of the cubes in each of which the map keeps one coloured point of the depth images; 0 keeps no "
                  "points.")
          .number("cloud_max_range_m", &Options::cloud_max_range, base::Range::positive(),
                  "Largest distance from the camera at which the map keeps coloured points of the depth images.");
  return table;
}

const base::OptionTable<HypothesisOptions>& HypothesisOptions::table() {
  using Options = HypothesisOptions;
  using Method = graph::ConsistencyOptions::Method;
  static const auto table =
      base::OptionTable<Options>()
          .choice("test", &Options::test,
                  {{"none", Method::none}, {"pairwise", Method::pairwise}, {"graduated", Method::graduated}},
                  "Consistency test of loop closures and other hypotheses. none: all are accepted. pairwise: they are "
                  "accepted one after the other, the most certain first. graduated: all are weighed together, and "
                  "those that do not fit lose their weight step by step (graduated non-convexity).")
          .number("confidence", &Options::confidence, base::Range{0.5, 0.999999999},
                  "Probability with which a true hypothesis passes the gates of the consistency test.")
          .number("min_likelihood_ratio", &Options::min_likelihood_ratio, base::Range{1, 1e12},
                  "A hypothesis is accepted by itself only if its measurement is at least this many times likelier if "
                  "the hypothesis is true than if it is false and the measurement could lie anywhere in the map. "
                  "Otherwise the hypothesis waits until another one confirms it.")
          .number("inflation", &Options::inflation, base::Range{1, 100},
                  "In the consistency test, the standard deviations that the map predicts are multiplied by this, "
                  "because odometry and laser odometry report smaller ones than they should.");
  return table;
}

EngineSettings EngineSettings::read(const base::Config& config) {
  EngineSettings settings;
  settings.engine = config.section("mapper").read<EngineOptions>();
  settings.trigger = config.section("trigger").read<TriggerOptions>();
  settings.solver = config.section("solver").read<SolverOptions>();
  settings.hypotheses = config.section("hypotheses").read<HypothesisOptions>();
  settings.session = config.section("session").read<SessionOptions>();
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
          .flag(
              "incremental", &Options::incremental,
              "While the map grows, the solution is followed from edit to edit, at a cost that depends on what an edit "
              "affects; false: each solve is one of the whole graph, as the last one always is.")
          .choice(
              "method", &Options::method,
              {{"levenberg_marquardt", Method::levenberg_marquardt}, {"dogleg", Method::dogleg}},
              "Method of nonlinear least squares by which the graph is solved: Levenberg-Marquardt or Powell's dogleg.")
          .integer("max_iterations", &Options::max_iterations, base::Range{1, 1e6},
                   "Largest number of iterations of a solve while the map grows.")
          .number("tolerance", &Options::tolerance, base::Range{0, 1},
                  "While the map grows, a solve ends after a step that lowers the cost by less than this share of it.")
          .integer("final_max_iterations", &Options::final_max_iterations, base::Range{1, 1e6},
                   "Largest number of iterations of the last solve, at the end of the log.")
          .number("final_tolerance", &Options::final_tolerance, base::Range{0, 1},
                  "At the end of the log, the last solve stops after a step that lowers the cost by less than this "
                  "share of it.");
  return table;
}

}  // namespace omnimapper::mapper
