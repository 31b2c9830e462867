#pragma once

#include <mrpt/serialization/CSerializable.h>
#include <omnimapper/base/ChildProcess.h>

#include <cstdint>
#include <functional>
#include <string>

namespace omnimapper::source {

/// Reads a log in a child process with 1 GiB of memory: MRPT's readers follow corrupt counts and pointers wherever they
/// lead, a crash included, and a checksum only says that nobody damaged the file by accident. The child runs ahead of
/// the one who reads on its word.
class SandboxedReader {
 public:
  enum class Answer { yes, no, not_known };

  /// Starts the child. `use` is what will be done with each object.
  SandboxedReader(const std::string& path, const std::function<void(mrpt::serialization::CSerializable&)>& use);

  /// Whether what follows the first `objects` objects can be read without harm. Waits until the child has come that
  /// far; `stop` is asked meanwhile, ten times a second, and if it is true the answer is not known.
  Answer mayReadAfter(std::uint64_t objects, const std::function<bool()>& stop);

 private:
  void count(const std::string& told);

  base::ChildProcess child_;
  std::uint64_t objects_ = 0;     // that the child has read
  bool has_good_ending_ = false;  // what follows them ends the reading in a way that the reader can meet itself
};

}  // namespace omnimapper::source
