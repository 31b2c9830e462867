// omnimapper-import: makes MRPT rawlogs of other programs' logs.
#include <omnimapper/base/Error.h>
#include <omnimapper/base/Progress.h>
#include <omnimapper/source/CarmenLog.h>
#include <omnimapper/source/RawlogWriter.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <iostream>
#include <map>

namespace {

using namespace omnimapper;
using source::CarmenOdometry;

const std::map<std::string, CarmenOdometry> kOdometryNames = {
    {"automatic", CarmenOdometry::automatic}, {"lines", CarmenOdometry::lines}, {"scans", CarmenOdometry::scans}};

void printSummary(const source::CarmenLog& log) {
  const auto report = log.report();
  std::cout << "lines read: " << report.objects << ", bad: " << log.badLineCount() << "\n" << report.text();
  for (const auto& bad : log.badLines()) std::cout << "line " << bad.number << " left out: it " << bad.reason << "\n";
  if (log.badLineCount() > log.badLines().size())
    std::cout << "... and " << log.badLineCount() - log.badLines().size() << " more bad lines\n";
  std::cout << "odometry: of the "
            << (log.odometry() == CarmenOdometry::lines ? "ODOM lines, and again of each scan" : "scans' own lines")
            << "; ODOM lines or repetitions left out: " << log.unusedOdometry() << "\n";
}

base::ExitCode importCarmen(const std::string& input, const std::string& output, CarmenOdometry odometry) {
  source::CarmenLog log(input, odometry);
  base::TerminalProgress progress(std::cerr, isatty(STDERR_FILENO) != 0);
  source::writeRawlog(output, [&](source::RawlogWriter& rawlog) {
    while (const auto observation = log.next()) {
      rawlog.add(*observation);
      progress.report(log.progress(), "importing " + input);
    }
  });
  printSummary(log);
  return log.report().exitCode();
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app(
      "Makes MRPT rawlogs of other programs' logs.\nExample: omnimapper-import carmen intel.clf.bz2 intel.rawlog",
      "omnimapper-import");
  app.require_subcommand(1);
  std::string input, output;
  std::string odometry = "automatic";
  auto* carmen = app.add_subcommand("carmen", "CARMEN log: scans (FLASER, RLASER, ROBOTLASER1, 2) and odometry");
  carmen->add_option("IN", input, "CARMEN log; may be compressed (.gz, .bz2)")->required();
  carmen->add_option("OUT", output, "rawlog to write")->required();
  carmen->add_option("--odometry", odometry, "automatic: lines if no stamp of the log runs backwards, else scans")
      ->check(CLI::IsMember(kOdometryNames))
      ->type_name("NAME");
  try {
    app.parse(argc, argv);
    return static_cast<int>(importCarmen(input, output, kOdometryNames.at(odometry)));
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : static_cast<int>(base::ExitCode::command_line);
  } catch (const base::Error& error) {
    std::cerr << "omnimapper-import: " << error.what() << "\n";
    return static_cast<int>(error.code());
  } catch (const std::exception& error) {
    std::cerr << "omnimapper-import: " << error.what() << "\n";
    return static_cast<int>(base::ExitCode::internal);
  }
}
