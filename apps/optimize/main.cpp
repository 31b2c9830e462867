// omnimapper-optimize: optimizes a pose graph in the format of g2o.
#include <omnimapper/base/Error.h>
#include <omnimapper/base/Progress.h>
#include <omnimapper/graph/OptimizeRun.h>
#include <unistd.h>

#include <iostream>
#include <map>
#include <optional>
#include <string>

#include "program/Program.h"

namespace {

using namespace omnimapper;
using graph::Loss;
using graph::OptimizeRequest;

const std::map<std::string, OptimizeRequest::Start> kStarts{{"best", OptimizeRequest::Start::best},
                                                            {"file", OptimizeRequest::Start::file},
                                                            {"odometry", OptimizeRequest::Start::odometry},
                                                            {"rotations", OptimizeRequest::Start::rotations}};
const std::map<std::string, Loss::Kind> kLosses{{"none", Loss::Kind::none},
                                                {"huber", Loss::Kind::huber},
                                                {"cauchy", Loss::Kind::cauchy},
                                                {"tukey", Loss::Kind::tukey}};

int optimize(OptimizeRequest& request, Loss::Kind loss, double scale, bool quiet) {
  request.closure_loss = loss == Loss::Kind::none ? Loss::none() : Loss(loss, scale);
  program::listenForInterrupts();
  std::optional<base::TerminalProgress> progress(std::in_place, std::cerr, isatty(STDERR_FILENO), quiet);
  request.progress = [&](double share) {
    progress->report(share, "optimizing");
    return !program::isInterrupted();
  };
  const auto result = graph::runOptimize(request);
  progress.reset();  // clears its line for the summary
  program::nothingIsLeftToDo();
  if (!quiet) std::cout << result.text;
  if (result.converged) return 0;
  return static_cast<int>(program::isInterrupted() ? base::ExitCode::interrupted : base::ExitCode::suspicious_map);
}

}  // namespace

int main(int argc, char** argv) {
  OptimizeRequest request;
  Loss::Kind loss = Loss::Kind::none;
  double scale = 1;
  bool incremental = false, quiet = false;
  CLI::App app(
      "Optimizes a graph of poses and points in the format of g2o, all at once or a pose at a time.\n"
      "Examples: omnimapper-optimize manhattan.g2o -o out/manhattan\n"
      "          omnimapper-optimize manhattan.g2o -o out/manhattan --incremental --sigmas",
      "omnimapper-optimize");
  app.add_option("GRAPH", request.input, "a .g2o file")->type_name("")->required();
  app.add_option("-o,--output", request.output, "folder for optimized.g2o, poses.csv and steps.csv, created if missing")
      ->required();
  app.add_flag("--incremental", incremental,
               "as a robot would have made the graph: a pose at a time, with all its edges to earlier ones; steps.csv "
               "has the time of each step");
  app.add_option(
         "--start", request.start,
         "where the poses start: file (as they are), odometry (chained along the edges), rotations (solved for first, "
         "for bad starts) or the better one of file and rotations, best; --incremental starts each from the one before "
         "it")
      ->transform(CLI::CheckedTransformer(kStarts))
      ->type_name("");
  app.add_option("--loss", loss, "robust loss of edges that close loops: none, huber, cauchy or tukey")
      ->transform(CLI::CheckedTransformer(kLosses))
      ->type_name("");
  app.add_option("--loss-scale", scale, "number of standard deviations from which it limits them (default: 1)")
      ->check(program::positive());
  app.add_flag("--sigmas", request.has_sigmas, "standard deviations in poses.csv");
  app.add_flag("-q,--quiet", quiet, "no summary");
  app.footer("Exit codes: doc/exit_codes.md (17: no minimum was reached). More: doc/optimize.md.");
  return program::run(app, argc, argv, [&] {
    if (incremental) request.method = OptimizeRequest::Method::incremental;
    return optimize(request, loss, scale, quiet);
  });
}
