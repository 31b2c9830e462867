// omnimapper-train-doorsigns: trains the model that distinguishes door signs from other regions of images.
#include <omnimapper/base/Progress.h>
#include <unistd.h>

#include <iostream>
#include <limits>
#include <optional>

#include "program/Program.h"
#include "salient_signs/TrainingRun.h"

namespace {

using namespace omnimapper;

struct Arguments {
  signs::TrainingRequest run;
  bool quiet = false;
};

void addOptions(CLI::App& app, Arguments& arguments) {
  auto& [request, quiet] = arguments;
  auto& options = request.options;
  app.add_option("folders", request.folders,
                 "folders of pictures, one for each building, with signs.csv or a NAME.mask.png for each picture")
      ->required();
  auto* output =
      app.add_option("-o,--output", request.output, "file of the model; without it only the tables are printed");
  app.add_option("--try", request.trial,
                 "test a model instead of training one: this file, or 'shipped' for the model of the program")
      ->excludes(output);
  app.add_option("--min-score", options.min_score, "smallest probability at which a region counts as a sign")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
  app.add_option("--folds", options.folds,
                 "number of folds of the cross-validation; all images of a sign are in the same fold")
      ->check(CLI::Range(2, 100))
      ->capture_default_str();
  app.add_option("--seed", options.seed, "seed of the random numbers")
      ->check(CLI::Range(0, std::numeric_limits<int>::max()))
      ->capture_default_str();
  app.add_option("--cost", options.cost, "cost of a misclassified region in the support vector machine")
      ->check(program::positive())
      ->capture_default_str();
  app.add_option("--gamma", options.gamma, "gamma of the kernel")->check(program::positive())->capture_default_str();
  app.add_option("--others", options.others, "largest number of other regions used from each picture")
      ->check(CLI::Range(1, 100000))
      ->capture_default_str();
  app.add_flag("-q,--quiet", quiet, "no progress, no tables");
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app(
      "Trains the model that distinguishes door signs from other regions, and prints how well it does: within each\n"
      "building, and trained on one building and tested on the others.\n"
      "Example: omnimapper-train-doorsigns photos/north photos/south -o door_signs.svm",
      "omnimapper-train-doorsigns");
  app.footer(
      "signs.csv has a line for each sign: image,sign,x1,y1,x2,y2,x3,y3,x4,y4,visible, with the corners upper left, "
      "upper\n"
      "right, lower right, lower left in pixels; its first line names the columns. In NAME.mask.png signs are white.\n"
      "Exit codes: doc/exit_codes.md.");
  Arguments arguments;
  addOptions(app, arguments);
  return program::run(app, argc, argv, [&] {
    program::listenForInterrupts();
    std::optional<base::TerminalProgress> progress(std::in_place, std::cerr, !arguments.quiet && isatty(STDERR_FILENO));
    const auto text = signs::runTraining(arguments.run, *progress, program::isInterrupted);
    progress.reset();  // clears its line for the tables
    if (!arguments.quiet) std::cout << text;
    return 0;
  });
}
