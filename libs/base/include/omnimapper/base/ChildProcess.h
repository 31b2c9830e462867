#pragma once

#include <sys/types.h>

#include <cstdint>
#include <functional>
#include <string>

namespace omnimapper::base {

/// A forked copy of this process in which something is tried that may crash or ask for memory without end. What happens
/// there, this process does not see. To be made before this process has other threads: a lock that one of them holds
/// stays locked in the child. It has `bytes` of memory beside what this one has now, leaves no core dump and
/// prints nothing. Its end is the destructor's, wherever it is.
class ChildProcess {
 public:
  /// The child does the work and ends with the exit code that it returns; what the work writes into the descriptor that
  /// it is given can be heard here. The work must not throw. Throws Error(internal) if no process can be made.
  ChildProcess(const std::function<int(int to_parent)>& work, std::uint64_t bytes);
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  /// Appends what the child has written, for which it waits so many milliseconds at most; if negative, as long as the
  /// child lives. False if nothing has come and the child has not ended.
  bool hear(std::string& said, int milliseconds);
  /// Whether the child has ended and all that it wrote was heard.
  bool isOver() const { return is_over_; }
  /// Waits for its end; the status is waitpid()'s.
  int status();

 private:
  pid_t process_ = -1;
  int from_child_ = -1;
  int status_ = 0;
  bool is_over_ = false;
};

/// How work ended that was tried in a child process.
struct ChildOutcome {
  enum class How {
    finished,
    threw,          ///< an exception that is no std::bad_alloc
    out_of_memory,  ///< it asked for more than it was given
    crashed,
  };
  How how = How::crashed;
  std::string message;  ///< of the exception
};

/// Does the work in a ChildProcess of so many bytes, and waits for its end. Throws Error(internal) if no process can be
/// made, and std::bad_alloc if this process may not have so much memory, or the machine has not.
ChildOutcome tryInChild(const std::function<void()>& work, std::uint64_t bytes);

}  // namespace omnimapper::base
