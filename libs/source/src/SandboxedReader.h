#pragma once

#include <omnimapper/base/ChildProcess.h>

#include <cstdint>
#include <functional>
#include <string>

namespace omnimapper::source {

/// Reads a log in a child process with 1 GiB of memory, because readers can crash on corrupt counts and pointers, and a
/// checksum only excludes accidental damage. The child reads ahead; its parent reads what the child has read without
/// harm.
class SandboxedReader {
 public:
  enum class Answer { yes, no, not_known };
  /// To be called after each step, such as an object, that did no harm. Returns false if nobody listens any more.
  using Took = std::function<bool()>;
  /// Reads the whole log step by step, as the parent will do it later. Returns whether the log ended in a way that the
  /// parent can handle itself.
  using ReadLog = std::function<bool(const Took& took)>;

  /// Starts the child, which calls `read`. An exception of `read` counts as harm.
  explicit SandboxedReader(const ReadLog& read);

  /// Whether the step after the first `steps` ones can be done without harm. Waits until the child has got that far.
  /// `stop` is called ten times a second meanwhile; if it returns true, the answer is not_known.
  Answer mayReadAfter(std::uint64_t steps, const std::function<bool()>& stop);

 private:
  void count(const std::string& received);

  base::ChildProcess child_;
  std::uint64_t steps_ = 0;       // number that the child has done
  bool has_good_ending_ = false;  // the log ends after them in a way that the parent can handle itself
};

}  // namespace omnimapper::source
