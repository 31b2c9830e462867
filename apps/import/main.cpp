// omnimapper-import: converts logs of other programs to MRPT rawlogs.
#include <omnimapper/base/AtomicFile.h>

#include <iostream>

#include "ImportArguments.h"
#include "importLog.h"
#include "program/Program.h"

namespace {

// Prints what to do next with the rawlog.
void sayNext(const std::string& output, bool has_only_photographs) {
  if (has_only_photographs) {
    std::cout << "next: omnimapper-perceive -i ini/signs.ini -r " << output
              << " -o signs.rawlog --pictures pictures --picture-every 1 finds door signs in them\n";
    return;
  }
  std::cout << "next: omnimapper-graphslam --check " << output << " names the INIs that fit it\n";
}

}  // namespace

int main(int argc, char** argv) {
  using namespace omnimapper;
  CLI::App app(
      "Converts logs of other programs to MRPT rawlogs.\nExample: omnimapper-import carmen intel.clf.bz2 "
      "intel.rawlog\n         omnimapper-import tum rgbd_dataset_freiburg1_rpy rpy.rawlog\n         omnimapper-import "
      "images photographs signs.rawlog",
      "omnimapper-import");
  app.require_subcommand(1);
  Arguments arguments;
  addFormats(app, arguments);
  return program::run(app, argc, argv, [&] {
    base::refuseToReplaceInput(arguments.output, {arguments.input});
    const auto code = importLog(arguments);
    sayNext(arguments.output, arguments.chosen().name == "image_folder");
    return static_cast<int>(code);
  });
}
