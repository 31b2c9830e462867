#pragma once

#include <functional>
#include <string>

#include "omnimapper/graph/Loss.h"

namespace omnimapper::graph {

struct OptimizeRequest {
  enum class Method { batch, incremental };
  enum class Start { best, file, odometry, rotations };
  std::string input;   ///< a .g2o file
  std::string output;  ///< folder, created if missing
  Method method = Method::batch;
  /// Where the batch solver starts: `best` is the file's poses, or `rotations` if their cost is lower. The incremental
  /// one starts each pose from the one before it.
  Start start = Start::best;
  /// For edges between poses that do not follow each other in the order of the file's numbers.
  Loss closure_loss = {};
  /// Whether poses.csv has standard deviations.
  bool has_sigmas = false;
  /// Called with the share that is done, from 0 to 1; if it returns false, the run ends with what it has.
  std::function<bool(double)> progress;
};

struct OptimizeResult {
  std::string text;  ///< a summary of at most one screen
  bool converged = false;
};

/// The work of omnimapper-optimize: moves the poses and points of a graph to a minimum of its cost and writes
/// optimized.g2o, poses.csv and, if incremental, steps.csv with the time of each step. Throws as readG2o(), solve() and
/// base::writeFile() do, Error(nothing_to_map) for a graph without edges, and
/// Error(unreadable_input), naming a vertex, for one of which a part is not held.
OptimizeResult runOptimize(const OptimizeRequest& request);

}  // namespace omnimapper::graph
