#pragma once

#include <cstdint>
#include <functional>
#include <string>

namespace omnimapper::base {

/// For a child process that was forked to try what may crash: it gets `bytes` of memory beside what it has now, leaves
/// no core dump and prints nothing.
void becomeTrial(std::uint64_t bytes);

/// How work ended that was tried in a child process.
struct TrialEnd {
  enum class How {
    finished,
    threw,          ///< an exception that is no std::bad_alloc
    out_of_memory,  ///< it asked for more than it was given
    crashed,
  };
  How how = How::crashed;
  std::string message;  ///< of the exception
};

/// Does the work in a child process that has `bytes` of memory beside what this one has, and waits for its end. What
/// the work changes, this process does not see. Throws Error(internal) if no process can be made, and std::bad_alloc if
/// this process may not have so much memory, or the machine has not.
TrialEnd tryInChild(const std::function<void()>& work, std::uint64_t bytes);

}  // namespace omnimapper::base
