#pragma once

#include <stdexcept>
#include <string>

namespace omnimapper::base {

/// Exit codes of the programs. doc/exit_codes.md describes them in more detail.
enum class ExitCode : int {
  ok = 0,
  internal = 1,          ///< a defect of the program
  command_line = 2,      ///< unknown flag, missing argument
  unknown_key = 3,       ///< INI: a section or key that is not known
  wrong_type = 4,        ///< INI: a value that is not a number, flag or choice
  out_of_range = 5,      ///< INI: a value beyond its bounds
  unknown_plugin = 6,    ///< INI: a class that is not registered
  plugin_library = 7,    ///< a plugin library that is missing or cannot be loaded
  unreadable_input = 8,  ///< an input that is missing or of the wrong kind
  damaged_input = 9,     ///< truncated or corrupt log: the map of what was readable is written
  unregistered_class =
      10,  ///< a log contains an object of a class that is not registered: the map of what came before is written
  missing_images = 11,     ///< external files of a log are missing: their observations are left out
  unwritable_output = 12,  ///< the output folder cannot be made or written
  disk_full = 13,          ///< an output could not be written completely
  nothing_to_map = 14,     ///< no observation that any plugin wants
  doubtful_input = 15,     ///< --check: the map of the log is likely wrong without the remedies that --check names
  not_located = 16,        ///< --localize: the log could not be located in the map
  suspicious_map = 17,     ///< --strict: the map is written but contradicts itself
  mostly_left_out = 18,    ///< the map is written, but from less than half of the observations
  out_of_memory = 19,      ///< files written before are kept
  nothing_found = 20,      ///< omnimapper-query: the map has no answer
  interrupted = 130,       ///< Ctrl-C: the map so far is written
};

/// The exception for every expected error. what() names the file or option, the place and the remedy.
class Error : public std::runtime_error {
 public:
  Error(ExitCode code, const std::string& message) : std::runtime_error(message), code_(code) {}
  ExitCode code() const { return code_; }

 private:
  ExitCode code_;
};

}  // namespace omnimapper::base
