#pragma once

#include <omnimapper/testing/ChildProgram.h>

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "Scenes.h"

namespace omnimapper::fuzz {

/// The input that has errors.
enum class Wrong { logs, maps, inis, folders };
inline constexpr std::array<const char*, 4> kNamesOfWrong{"logs", "maps", "inis", "folders"};

/// One run of a program of the project on input with errors.
struct FuzzedRun {
  std::string name;                  ///< name of its scene
  std::vector<std::string> command;  ///< argv
};

/// Makes runs. Each depends only on its number.
class FuzzedRuns {
 public:
  /// `scratch` is an empty folder for files that all runs share. Throws std::runtime_error if a program fails on valid
  /// input.
  FuzzedRuns(Wrong wrong, const std::string& programs, const std::string& scratch);

  /// Writes the files of the run into `folder`, whose content is removed first.
  FuzzedRun make(std::uint64_t number, const std::string& folder) const;

 private:
  struct Made {
    std::size_t scene;  // in scenes_
    map::MapFile map;
  };
  std::vector<std::string> command(const Scene& scene, const std::string& log, const std::string& folder) const;
  FuzzedRun ofLog(Dice& dice, const std::string& folder) const;
  FuzzedRun ofMap(Dice& dice, const std::string& folder) const;
  FuzzedRun ofIni(Dice& dice, const std::string& folder) const;
  FuzzedRun ofFolder(Dice& dice, const std::string& folder) const;

  Wrong wrong_;
  std::string programs_, scratch_;
  std::vector<Scene> scenes_;
  std::vector<std::string> logs_;  // paths of the unchanged logs of scenes_
  std::vector<Made> maps_;         // maps of the scenes that are mapped
};

struct Bounds {
  double seconds = 30, mib = 2048;
};

/// What is wrong with the end of a run: a signal, "a defect", more time or memory than the bounds, an exit code that is
/// not in doc/exit_codes.md, a failure without a message, or escape codes on the terminal. None if nothing is wrong.
std::optional<std::string> complaint(const testing::Ended& ended, const Bounds& bounds);

}  // namespace omnimapper::fuzz
