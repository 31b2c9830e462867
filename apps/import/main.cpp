// omnimapper-import: converts logs of other programs to MRPT rawlogs.
#include <omnimapper/base/AtomicFile.h>

#include "ImportArguments.h"

int main(int argc, char** argv) {
  using namespace omnimapper;
  CLI::App app(
      "Converts logs of other programs to MRPT rawlogs.\nExample: omnimapper-import carmen intel.clf.bz2 "
      "intel.rawlog\n         omnimapper-import tum rgbd_dataset_freiburg1_rpy rpy.rawlog\n         omnimapper-import "
      "images photographs signs.rawlog",
      "omnimapper-import");
  app.require_subcommand(1);
  Arguments arguments;
  const auto import = addKinds(app, arguments);
  return program::run(app, argc, argv, [&] {
    base::refuseToReplaceInput(arguments.output, {arguments.input});
    const auto code = import();
    sayNext(arguments.output, app.got_subcommand("images"));
    return static_cast<int>(code);
  });
}
