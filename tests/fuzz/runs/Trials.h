#pragma once

#include <omnimapper/testing/Program.h>

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "Scenes.h"

namespace omnimapper::fuzz {

/// What is made wrong.
enum class Wrong { logs, maps, inis, folders };
inline constexpr std::array<const char*, 4> kNamesOfWrong{"logs", "maps", "inis", "folders"};

/// One run of a program of the project on something that is wrong.
struct Trial {
  std::string name;                  ///< of its scene
  std::vector<std::string> command;  ///< argv
};

/// Makes trials, each from its number alone.
class Trials {
 public:
  /// `scratch` is an empty folder for what all trials share. Throws std::runtime_error if a program cannot map what is
  /// sound.
  Trials(Wrong wrong, const std::string& programs, const std::string& scratch);

  /// Writes its files into `folder`, which is emptied before.
  Trial make(std::uint64_t number, const std::string& folder) const;

 private:
  struct Made {
    std::size_t scene;  // in scenes_
    map::MapFile map;
  };
  std::vector<std::string> command(const Scene& scene, const std::string& log, const std::string& folder) const;
  Trial ofLog(Dice& dice, const std::string& folder) const;
  Trial ofMap(Dice& dice, const std::string& folder) const;
  Trial ofIni(Dice& dice, const std::string& folder) const;
  Trial ofFolder(Dice& dice, const std::string& folder) const;

  Wrong wrong_;
  std::string programs_, scratch_;
  std::vector<Scene> scenes_;
  std::vector<std::string> logs_;  // of scenes_, as they are
  std::vector<Made> maps_;         // one for each scene that is mapped
};

struct Bounds {
  double seconds = 30, mib = 2048;
};

/// What is wrong with how a trial ended: a signal, "a defect", longer or with more memory than the bounds, an exit code
/// that doc/exit_codes.md has not, a failure without a word, escape codes on the terminal. None: nothing is.
std::optional<std::string> complaint(const testing::Ended& ended, const Bounds& bounds);

}  // namespace omnimapper::fuzz
