#include <iostream>

#include "Imports.h"

using namespace omnimapper;

void refuseNothing(const std::string& input, const source::SourceReport& report) {
  if (report.observations() > 0) return;
  throw base::Error(base::ExitCode::unreadable_input,
                    input + ": nothing of it can be imported; nothing was written.\nWhat was read:\n" + report.text());
}

void sayNext(const std::string& output) {
  std::cout << "next: omnimapper-graphslam --check " << output << " names the INIs that fit it\n";
}
