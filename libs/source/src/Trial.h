#pragma once

#include <mrpt/serialization/CSerializable.h>

#include <cstdint>
#include <functional>
#include <string>

namespace omnimapper::source {

/// How far a file can be read without harm.
struct Trial {
  std::uint64_t objects = 0;  ///< objects that can be read
  bool may_read_next = true;  ///< whether what follows them is known to end the reading in good order
};

/// True if the file is compressed and its checksum says that every byte is as it was written.
bool isVerified(const std::string& path);

/// Reads a file that no checksum vouches for, in a child process with 1 GiB of memory: MRPT's readers follow corrupt
/// counts and pointers wherever they lead, a crash included. `use` is what will be done with each object.
Trial tryReading(const std::string& path, const std::function<void(mrpt::serialization::CSerializable&)>& use);

}  // namespace omnimapper::source
