#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

namespace omnimapper::source {

/// Reads a file that may be compressed with gzip or bzip2 (detected by its first bytes) and, unlike zlib's own
/// gzread(), reports whether its end is intact. Several compressed members in a row are one file; zeros after them are
/// ignored.
class CompressedFile {
 public:
  enum class Ending { open, end, truncated, corrupt };

  /// Throws Error(unreadable_input) if the file cannot be opened, is a folder or empty.
  explicit CompressedFile(const std::string& path);
  ~CompressedFile();

  /// Bytes read into `buffer`; fewer than `size` only when the ending is not `open` any more.
  std::size_t read(void* buffer, std::size_t size);
  Ending ending() const;
  /// What is wrong with the file: "gzip: incorrect data check". Empty if the ending is good.
  const std::string& problem() const;
  bool isCompressed() const;
  /// Uncompressed bytes handed out.
  std::uint64_t position() const;
  /// Part of the file on disk that has been read, in [0, 1].
  double fraction() const;
  const std::string& path() const;

  class Decoder;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace omnimapper::source
