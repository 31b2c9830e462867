#include <omnimapper/source/RawlogWriter.h>

#include <iostream>

#include "Imports.h"

namespace {

using namespace omnimapper;
using source::CarmenOdometry;

void printSummary(const source::CarmenLog& log) {
  const auto report = log.report();
  std::cout << "lines read: " << report.objects << ", bad: " << log.badLineCount() << "\n" << report.text();
  for (const auto& bad : log.badLines()) std::cout << "line " << bad.number << " left out: it " << bad.reason << "\n";
  if (log.badLineCount() > log.badLines().size())
    std::cout << "... and " << log.badLineCount() - log.badLines().size() << " more bad lines\n";
  std::cout << "odometry: of the "
            << (log.odometry() == CarmenOdometry::lines ? "ODOM lines, and repeated for each scan" : "scans' own lines")
            << "; ODOM lines or repetitions left out: " << log.unusedOdometry() << "\n";
}

}  // namespace

base::ExitCode importCarmen(const std::string& input, const std::string& output, CarmenOdometry odometry) {
  source::CarmenLog log(input, odometry);
  ImportProgress progress(input);
  source::writeRawlog(output, [&](source::RawlogWriter& rawlog) {
    while (const auto observation = log.next()) {
      rawlog.add(*observation);
      progress.report(log.progress());
    }
    refuseNothing(input, log.report());
  });
  printSummary(log);
  return log.report().exitCode();
}
