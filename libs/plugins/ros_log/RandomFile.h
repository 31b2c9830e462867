#pragma once

#include <cstdint>
#include <string>

namespace omnimapper::ros {

/// Bytes with which every log of ROS shows its kind.
inline constexpr std::size_t kLogHead = 64;

/// A file that is read at any place.
class RandomFile {
 public:
  /// Throws Error(unreadable_input) if the file cannot be opened or is no regular file.
  explicit RandomFile(const std::string& path);
  ~RandomFile();
  RandomFile(const RandomFile&) = delete;
  RandomFile& operator=(const RandomFile&) = delete;

  std::uint64_t size() const { return size_; }
  /// The bytes from `offset` on; fewer at the end of the file, and where the disk fails.
  std::string read(std::uint64_t offset, std::uint64_t count) const;
  /// The same for a few bytes, many times in a row: from a buffer.
  std::string readSmall(std::uint64_t offset, std::uint64_t count) const;

 private:
  int file_;
  std::uint64_t size_ = 0;
  mutable std::string buffer_;
  mutable std::uint64_t buffer_offset_ = 0;
};

}  // namespace omnimapper::ros
