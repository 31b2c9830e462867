#include <unistd.h>

#include <iostream>

#include "Imports.h"
#include "program/Program.h"

using namespace omnimapper;

void refuseNothing(const std::string& input, const source::SourceReport& report) {
  if (report.observations() > 0) return;
  throw base::Error(base::ExitCode::unreadable_input,
                    input + ": nothing of it can be imported; nothing was written.\nWhat was read:\n" + report.text());
}

ImportProgress::ImportProgress(const std::string& input)
    : what_("importing " + input), terminal_(std::cerr, isatty(STDERR_FILENO) != 0) {
  program::listenForInterrupts();
}

void ImportProgress::report(double share) {
  if (program::isInterrupted()) throw base::Error(base::ExitCode::interrupted, "interrupted; no rawlog was written");
  terminal_.report(share, what_);
}

void sayNext(const std::string& output) {
  std::cout << "next: omnimapper-graphslam --check " << output << " names the INIs that fit it\n";
}
