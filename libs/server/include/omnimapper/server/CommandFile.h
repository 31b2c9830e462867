#pragma once

#include <omnimapper/obs/CObservationCommand.h>

#include <string>

namespace omnimapper::server {

/// A table of commands (obs::commandIn()) for a live run, whose driver CCommandFile reads what is appended.
class CommandFile {
 public:
  /// Does not touch the file before the first command.
  explicit CommandFile(std::string path) : path_(std::move(path)) {}

  /// Appends a command; it is on the disk when this returns. Its stamp is moved to after that of the last command, so
  /// that stamps increase. Throws Error(unwritable_output) if the file cannot be opened or is no regular file, and
  /// Error(disk_full) if it cannot be written; the file then has no part of the command.
  void append(obs::CObservationCommand command);

 private:
  std::string path_;
  base::Stamp last_;
};

}  // namespace omnimapper::server
