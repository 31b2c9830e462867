#pragma once

#include <omnimapper/base/Config.h>
#include <omnimapper/base/OptionTable.h>
#include <omnimapper/graph/Consistency.h>
#include <omnimapper/graph/Solver.h>
#include <omnimapper/mapper/SessionOptions.h>
#include <omnimapper/mapper/Trigger.h>
#include <omnimapper/plugin/Motion.h>

#include <string>
#include <vector>

namespace omnimapper::mapper {

/// Options of the point cloud that key frames keep of depth images.
struct CloudOptions {
  double voxel = 0.05;   ///< [m]; 0: no cloud is kept
  double max_range = 5;  ///< [m]
};

/// Section [mapper] of an INI.
struct EngineOptions {
  Motion motion = Motion::planar;
  std::vector<std::string> pose_plugins, measurement_plugins, output_plugins;
  std::vector<std::string> default_plugins{"LevelPlugin"};  ///< classes of measurement plugins
  std::vector<std::string> sensors;
  std::vector<std::string> plugin_libraries;
  std::string reference_sensor;  ///< label; empty: the first sensor that gets a key frame
  double window = 0.5;           ///< [s]
  double horizon = 30;           ///< [s]
  int queue_limit = 10000;       ///< stamps
  int job_delay = 5;             ///< key frames
  int solve_every = 100;         ///< key frames
  int solve_after_closure = 10;  ///< key frames
  double solve_growth = 0.1;     ///< share of the key frames
  double cloud_voxel = 0.05;     ///< [m]
  double cloud_max_range = 5;    ///< [m]

  CloudOptions cloud() const { return {cloud_voxel, cloud_max_range}; }

  static const base::OptionTable<EngineOptions>& table();
};

/// Section [hypotheses] of an INI.
struct HypothesisOptions {
  graph::ConsistencyOptions::Method test = graph::ConsistencyOptions().method;
  double confidence = graph::ConsistencyOptions().confidence;
  double inflation = 2;
  double min_likelihood_ratio = graph::ConsistencyOptions().min_likelihood_ratio;

  graph::ConsistencyOptions consistency() const { return {test, confidence, inflation, min_likelihood_ratio}; }
  static const base::OptionTable<HypothesisOptions>& table();
};

/// Section [perception] of an INI.
struct PerceptionOptions {
  std::vector<std::string> extractors;

  static const base::OptionTable<PerceptionOptions>& table();
};

/// Section [solver] of an INI.
struct SolverOptions {
  bool incremental = true;
  graph::SolveOptions::Method method = graph::SolveOptions().method;
  int max_iterations = 20;
  double tolerance = 1e-4;
  int final_max_iterations = 100;
  double final_tolerance = 1e-9;

  static const base::OptionTable<SolverOptions>& table();
  /// Options of the solves while the map grows (running) and of the last solve (final).
  graph::SolveOptions running() const { return {method, max_iterations, tolerance, {}}; }
  graph::SolveOptions final() const { return {method, final_max_iterations, final_tolerance, {}}; }
};

/// All settings of the engine itself in an INI.
struct EngineSettings {
  EngineOptions engine;
  TriggerOptions trigger;
  SolverOptions solver;
  HypothesisOptions hypotheses;
  SessionOptions session;

  /// Reads [mapper], [trigger], [solver], [hypotheses] and [session]. Throws base::Error as
  /// base::ConfigSection::read().
  static EngineSettings read(const base::Config& config);
};

}  // namespace omnimapper::mapper
