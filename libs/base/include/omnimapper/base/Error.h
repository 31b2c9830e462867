#pragma once

#include <stdexcept>
#include <string>

namespace omnimapper::base {

/// What a program of the project tells its caller: its exit code. doc/exit_codes.md is the same table in words.
enum class ExitCode : int {
  ok = 0,
  internal = 1,             ///< a defect of ours
  command_line = 2,         ///< unknown flag, missing argument
  unknown_key = 3,          ///< INI: a section or key that nobody reads
  wrong_type = 4,           ///< INI: a value that is no number, no flag, no choice
  out_of_range = 5,         ///< INI: a value beyond its bounds
  unknown_plugin = 6,       ///< INI: a class nobody registered
  plugin_library = 7,       ///< a plugin library that is missing or cannot be loaded
  unreadable_input = 8,     ///< an input that is missing, or not of the kind it should be
  damaged_input = 9,        ///< truncated or corrupt log: the map of what was readable is written
  unregistered_class = 10,  ///< a log holds a class nobody registered: the map of what came before it is written
  missing_images = 11,      ///< external files of a log are missing: those observations are left out
  unwritable_output = 12,   ///< the output folder cannot be made or written
  disk_full = 13,           ///< an output could not be written whole
  nothing_to_map = 14,      ///< no observation that any plugin wants
  doubtful_input = 15,      ///< --check: a log that is likely mapped wrong without the remedies it names
  not_located = 16,         ///< --localize: the log was found nowhere in the map
  suspicious_map = 17,      ///< --strict: the map is written, and contradicts itself
  mostly_left_out = 18,     ///< the map is written, of less than half of the observations
  out_of_memory = 19,       ///< what was written until then is kept
  nothing_found = 20,       ///< omnimapper-query: the map has no answer
  interrupted = 130,        ///< Ctrl-C: the map so far is written
};

/// Every error a library of the project throws on purpose. what() names the file or option, the place and the remedy.
class Error : public std::runtime_error {
 public:
  Error(ExitCode code, const std::string& message) : std::runtime_error(message), code_(code) {}
  ExitCode code() const { return code_; }

 private:
  ExitCode code_;
};

}  // namespace omnimapper::base
