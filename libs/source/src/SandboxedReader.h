#pragma once

#include <mrpt/serialization/CSerializable.h>
#include <omnimapper/base/ChildProcess.h>

#include <cstdint>
#include <functional>
#include <string>

namespace omnimapper::source {

/// Reads a log in a child process with 1 GiB of memory, because MRPT's readers can crash on corrupt counts and
/// pointers, and a checksum only excludes accidental damage. The child reads ahead; its parent reads what the child has
/// read without harm.
class SandboxedReader {
 public:
  enum class Answer { yes, no, not_known };

  /// Starts the child, which calls `use` for each object, as the parent will process it later.
  SandboxedReader(const std::string& path, const std::function<void(mrpt::serialization::CSerializable&)>& use);

  /// Whether the object after the first `objects` ones can be read without harm. Waits until the child has got that
  /// far. `stop` is called ten times a second meanwhile; if it returns true, the answer is not_known.
  Answer mayReadAfter(std::uint64_t objects, const std::function<bool()>& stop);

 private:
  void count(const std::string& received);

  base::ChildProcess child_;
  std::uint64_t objects_ = 0;     // number that the child has read
  bool has_good_ending_ = false;  // the log ends after them in a way that the parent can handle itself
};

}  // namespace omnimapper::source
