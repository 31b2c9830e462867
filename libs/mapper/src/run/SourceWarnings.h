#pragma once

#include <omnimapper/source/ObservationSource.h>

#include <string>
#include <vector>

namespace omnimapper::mapper {

/// What whoever reads a map or a derived log should know of the log it was made of.
inline std::vector<std::string> warningsOf(const source::SourceReport& report) {
  std::vector<std::string> warnings;
  if (!report.message.empty()) warnings.push_back(report.message);
  for (const auto& sentence : report.unusableText()) warnings.push_back(sentence);
  if (report.has_logs_apart) {
    warnings.push_back(
        "one of the merged logs lies in time a minute or more from all others: are they of one drive, and do the "
        "clocks of their computers agree? A log of another drive is a session: map it with --continue");
  }
  if (report.missing_images > 0) {
    warnings.push_back(std::to_string(report.missing_images) +
                       " observations were left out because an external file of theirs cannot be read, first " +
                       report.first_missing_image +
                       "; put the files there, or name their folder as [source] images_folder");
  }
  return warnings;
}

}  // namespace omnimapper::mapper
