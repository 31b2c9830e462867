#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

namespace omnimapper::plugins {

/// omnimapper-serve as a child process with a process group of its own, so that Ctrl-C is the run's alone. It ends with
/// this object, and also if this process is killed.
class PageServer {
 public:
  /// Starts the program beside this one with `arguments`, and waits until it says where the page is. Throws
  /// Error(unreadable_input) with what it said if it ended instead, and Error(internal) if it cannot be started.
  explicit PageServer(std::vector<std::string> arguments);
  ~PageServer();
  PageServer(const PageServer&) = delete;
  PageServer& operator=(const PageServer&) = delete;

  /// The whole lines that it said since the last call. Does not wait.
  std::vector<std::string> takeLines();
  bool isRunning();
  /// How it ended, a few words.
  const std::string& howItEnded() const { return how_it_ended_; }

 private:
  void hear(int milliseconds);

  pid_t process_ = -1;
  int to_child_ = -1, from_child_ = -1;
  std::string said_, how_it_ended_;
};

}  // namespace omnimapper::plugins
