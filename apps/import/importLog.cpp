#include "importLog.h"

#include <omnimapper/base/AtomicFile.h>
#include <omnimapper/base/Names.h>
#include <omnimapper/geometry/TumLine.h>
#include <omnimapper/source/RawlogWriter.h>
#include <omnimapper/source/SourceFactory.h>
#include <omnimapper/source/openLogs.h>

#include <filesystem>
#include <iostream>

#include "copyLog.h"
#include "program/Program.h"

using namespace omnimapper;

namespace {

std::unique_ptr<source::ObservationSource> opened(const Arguments& arguments) {
  const auto& format = arguments.chosen();
  auto config = base::Config::fromText("", "the command line");
  const auto section = source::sectionOfFormat(format.name);
  for (const auto& [key, value] : format.values) {
    if (!value.empty()) config.set(section + "." + key + "=" + value);
  }
  source::SourceOptions options;
  try {
    options = source::readSourceOptions(config);
  } catch (const base::Error& error) {
    throw base::Error(base::ExitCode::command_line, error.what());
  }
  return source::openLogAs(format.name, arguments.input, options, program::isInterrupted);
}

}  // namespace

base::ExitCode importLog(const Arguments& arguments) {
  program::listenForInterrupts();
  const auto log = opened(arguments);
  const auto truth = log->truth();
  if (arguments.poses && truth.empty())
    throw base::Error(base::ExitCode::unreadable_input,
                      arguments.input + " has no ground truth for --poses; nothing was written");
  std::size_t posed = 0;
  source::writeRawlog(
      arguments.output, [&](source::RawlogWriter& rawlog) { posed = copyLog(*log, arguments, rawlog); },
      source::ColourImages::jpeg);
  const auto report = log->report();
  std::cout << base::printableLines(report.text());
  if (arguments.poses) std::cout << "observations with a true pose in the rawlog: " << posed << "\n";
  if (!truth.empty()) {
    const auto file = std::filesystem::path(arguments.output).replace_extension().string() + ".truth.tum";
    base::writeFile(file, [&](std::ostream& out) {
      for (const auto& [stamp, pose] : truth) out << geometry::tumLine(stamp, pose);
    });
    std::cout << "ground truth that the log has: " << file << ", " << truth.size() << " poses\n";
  }
  for (const auto& doubt : report.doubts)
    std::cerr << "omnimapper-import: warning: " << base::printableLines(doubt) << "\n";
  return report.exitCode();
}
