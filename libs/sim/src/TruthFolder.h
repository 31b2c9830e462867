#pragma once

#include <omnimapper/sim/Sensor.h>

#include <fstream>
#include <map>
#include <string>
#include <vector>

namespace omnimapper::sim {

/// Writes the folder truth/ of a run.
class TruthFolder {
 public:
  /// `folder` must exist.
  explicit TruthFolder(const std::string& folder) : folder_(folder) {}

  /// Throws Error(unwritable_output) or Error(disk_full).
  void add(const Sensor& sensor, int k, const Measurement& measurement);
  /// To be called after the last measurement. Throws Error(disk_full).
  void close();

  /// Names relative to the folder, each kind sorted; folders of many files end in a slash.
  std::vector<std::string> files() const;

 private:
  void addLine(const std::string& file, const std::string& first_line, const std::string& text);

  std::string folder_;
  std::map<std::string, std::ofstream> open_;  // files of many measurements, by their names in truth/
  std::vector<std::string> closed_;
  std::map<std::string, int> folders_;  // folders of separate files, with the number of files
};

}  // namespace omnimapper::sim
