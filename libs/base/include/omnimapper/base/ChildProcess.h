#pragma once

#include <sys/types.h>

#include <cstdint>
#include <functional>
#include <string>

namespace omnimapper::base {

/// A child process, forked from this process, for work that may crash or use up the memory. What the work changes in
/// memory is not changed in this process. A child must be created before this process has other threads, because a lock
/// that such a thread holds would stay locked in the child. The child may use `bytes` of memory in addition to what
/// this process has now; it leaves no core dump and prints nothing. The destructor kills the child if it is still
/// running.
class ChildProcess {
 public:
  /// The child runs `work` and ends with the exit code that `work` returns. hear() receives what `work` writes to the
  /// descriptor `to_parent`. `work` must not throw. The constructor throws Error(internal) if the process cannot be
  /// started.
  ChildProcess(const std::function<int(int to_parent)>& work, std::uint64_t bytes);
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  /// Waits for output of the child and appends it to `said`. Waits at most `milliseconds`; if that is negative, as long
  /// as the child lives. Returns false if nothing has come and the child has not ended.
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
    out_of_memory,  ///< the work needed more memory than the child was given
    crashed,
  };
  How how = How::crashed;
  std::string message;  ///< the message of the exception, if the work threw one
};

/// Does the work in a ChildProcess with `bytes` of memory and waits for the end of the child. Throws Error(internal) if
/// the process cannot be started, and std::bad_alloc if this process or the machine has less memory than `bytes`.
ChildOutcome tryInChild(const std::function<void()>& work, std::uint64_t bytes);

}  // namespace omnimapper::base
