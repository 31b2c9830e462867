#include <omnimapper/source/RawlogWriter.h>
#include <unistd.h>

#include <iostream>

#include "Imports.h"
#include "program/Program.h"

using namespace omnimapper;

void refuseNothing(const std::string& input, const source::SourceReport& report) {
  if (report.observations() > 0) return;
  throw base::Error(
      base::ExitCode::unreadable_input,
      input + ": contains nothing that can be imported; nothing was written.\nWhat was read:\n" + report.text());
}

ImportProgress::ImportProgress(const std::string& input)
    : what_("importing " + input), terminal_(std::cerr, isatty(STDERR_FILENO) != 0) {
  program::listenForInterrupts();
}

void ImportProgress::report(double share) {
  if (program::isInterrupted()) throw base::Error(base::ExitCode::interrupted, "interrupted; no rawlog was written");
  terminal_.report(share, what_);
}

void importFolder(source::FolderSource& files, const std::string& folder, const std::string& output) {
  ImportProgress progress(folder);
  source::writeRawlog(
      output,
      [&](source::RawlogWriter& rawlog) {
        while (const auto observation = files.next()) {
          rawlog.add(*observation);
          progress.report(files.progress());
        }
        refuseNothing(folder, files.report());
      },
      source::ColourImages::jpeg);
  std::cout << files.report().text()
            << (files.areNamesTimes() ? "stamps: from the names of the files\n"
                                      : "stamps: assigned with --rate, because the files' names are no Unix times\n");
}

void sayNext(const std::string& output, bool has_only_photographs) {
  if (has_only_photographs) {
    std::cout << "next: omnimapper-perceive -i ini/signs.ini -r " << output
              << " -o signs.rawlog --pictures pictures --picture-every 1 finds door signs in them\n";
    return;
  }
  std::cout << "next: omnimapper-graphslam --check " << output << " names the INIs that fit it\n";
}
