#pragma once

#include <sys/types.h>

#include <cstdint>
#include <functional>
#include <string>

namespace omnimapper::base {

/// A forked copy of this process, for work that may crash or use up the memory. This process does not see its changes.
/// It must be created before this process has other threads, because a lock held by one of them would stay locked in
/// the child. It may use `bytes` of memory in addition to what this process has now, leaves no core dump and prints
/// nothing. The destructor kills it if it is still running.
class ChildProcess {
 public:
  /// The child does the work and ends with the exit code that it returns; hear() receives what the work writes to the
  /// descriptor. The work must not throw. Throws Error(internal) if the process cannot be started.
  ChildProcess(const std::function<int(int to_parent)>& work, std::uint64_t bytes);
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  /// Appends the output of the child, for which it waits at most `milliseconds`; if negative, as long as the child
  /// lives. False if nothing has come and the child has not ended.
  bool hear(std::string& said, int milliseconds);
  /// Whether the child has ended and all its output was received.
  bool isOver() const { return is_over_; }
  /// Waits for the end of the child and returns the status of waitpid().
  int status();

 private:
  pid_t process_ = -1;
  int from_child_ = -1;
  int status_ = 0;
  bool is_over_ = false;
};

/// The outcome of work in a child process.
struct ChildOutcome {
  enum class How {
    finished,
    threw,          ///< an exception other than std::bad_alloc
    out_of_memory,  ///< it needed more memory than it was given
    crashed,
  };
  How how = How::crashed;
  std::string message;  ///< message of the exception
};

/// Does the work in a ChildProcess with `bytes` of memory and waits for its end. Throws Error(internal) if the process
/// cannot be started, and std::bad_alloc if this process or the machine does not have that much memory.
ChildOutcome tryInChild(const std::function<void()>& work, std::uint64_t bytes);

}  // namespace omnimapper::base
