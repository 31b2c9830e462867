#pragma once

#include <omnimapper/base/Stamp.h>
#include <omnimapper/server/CommandFile.h>
#include <omnimapper/server/Tickets.h>

#include <string>
#include <vector>

namespace omnimapper::server {

/// What a page asks of a live run.
class RunCommands {
 public:
  static constexpr double kDriveExpiry = 5;  ///< [s] after which a robot must not begin to drive

  explicit RunCommands(const std::string& file) : file_(file) {}

  std::string ticket(base::Stamp now) { return tickets_.give(now); }
  /// Asks to go to what is called `goal`. Throws Error(command_line) if the ticket is none, was used or is too old, or
  /// if the goal is no text of 1 to 200 bytes, and as CommandFile::append() does.
  void goTo(const std::string& goal, const std::string& ticket, base::Stamp now);
  void stop(base::Stamp now);
  /// Asks for a change of names, words as query::LabelEdit has them. Throws Error(command_line) if they are none.
  void label(const std::vector<std::string>& words, base::Stamp now);

 private:
  void give(obs::CommandKind kind, const std::string& text, double expiry, base::Stamp now);

  CommandFile file_;
  Tickets tickets_;
};

}  // namespace omnimapper::server
