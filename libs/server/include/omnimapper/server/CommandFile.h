#pragma once

#include <omnimapper/obs/CObservationCommand.h>

#include <string>

namespace omnimapper::server {

/// A table of commands (obs::commandIn()) for a live run, whose driver CCommandFile reads what is appended.
class CommandFile {
 public:
  /// Does not touch the file before the first command.
  explicit CommandFile(std::string path) : path_(std::move(path)) {}

  /// Appends a command; it is on the disk when this returns. Its stamp is moved to after those of the last rows of the
  /// file, so that stamps increase. Throws Error(unwritable_output) if the file cannot be opened, is no regular file,
  /// or has another first line than obs::kCommandColumns, under which the row would be misread, or if the rows of the
  /// file are later than the command by more than 5 s, because the clock was set back (but for a stop), and
  /// Error(disk_full) if it cannot be written; the file then has no part of the command.
  void append(obs::CObservationCommand command);

 private:
  std::string path_;
};

}  // namespace omnimapper::server
