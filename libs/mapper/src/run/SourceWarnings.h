#pragma once

#include <omnimapper/base/Numbers.h>
#include <omnimapper/source/ObservationSource.h>

#include <string>
#include <vector>

namespace omnimapper::mapper {

/// Warnings about a log, for the reader of the map or the derived log that was made of it.
inline std::vector<std::string> warningsOf(const source::SourceReport& report) {
  std::vector<std::string> warnings;
  if (!report.message.empty()) warnings.push_back(report.message);
  for (const auto& sentence : report.unusableText()) warnings.push_back(sentence);
  warnings.insert(warnings.end(), report.doubts.begin(), report.doubts.end());
  if (report.has_logs_apart) {
    warnings.push_back(
        "the stamps of one of the merged logs are a minute or more away from all others: are the logs of one drive, "
        "and do the clocks of their computers agree? A log of another drive is a session: map it with --continue");
  }
  if (report.missing_images > 0) {
    warnings.push_back(
        base::counted(report.missing_images, "observation") + " " + base::wasOrWere(report.missing_images) +
        " left out because one of their external files cannot be read, first " + report.first_missing_image +
        "; put the files there, or name their folder as [source] images_folder");
  }
  return warnings;
}

}  // namespace omnimapper::mapper
