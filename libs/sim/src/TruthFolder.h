#pragma once

#include <omnimapper/sim/Sensor.h>

#include <fstream>
#include <map>
#include <string>
#include <vector>

namespace omnimapper::sim {

/// The folder truth/ of a run while it is filled.
class TruthFolder {
 public:
  /// `folder` exists. Throws Error(unwritable_output).
  explicit TruthFolder(const std::string& folder) : folder_(folder) {}

  /// Throws Error(disk_full).
  void add(const Sensor& sensor, int k, const Measurement& measurement);
  /// After the last. Throws Error(disk_full).
  void close();

  /// Relative to the folder, sorted; folders of many files end in a slash.
  std::vector<std::string> files() const;

 private:
  std::string pathOf(const std::string& label) const;

  std::string folder_;
  std::map<std::string, std::ofstream> lines_;  // by label
  std::vector<std::string> labels_;
  std::map<std::string, int> folders_;  // of files of their own, with how many
};

}  // namespace omnimapper::sim
