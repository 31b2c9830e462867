#pragma once

#include <omnimapper/source/CompressedFile.h>

#include <string>

namespace omnimapper::source {

/// Lines of a text file, compressed or not.
class TextFileLines {
 public:
  /// Throws as CompressedFile.
  explicit TextFileLines(const std::string& path) : file_(path) {}

  /// Reads the next line, without its line feed. Returns false at the end of the file, of whatever kind.
  bool next(std::string& line);
  /// Whether the last line was whole: ended by a line feed and shorter than a megabyte.
  bool isWhole() const { return is_whole_; }
  /// Number of the last line, from 1.
  std::uint64_t number() const { return number_; }
  const CompressedFile& file() const { return file_; }

 private:
  bool refill();

  CompressedFile file_;
  std::string buffer_;
  std::size_t next_ = 0;
  std::uint64_t number_ = 0;
  bool is_whole_ = true;
};

}  // namespace omnimapper::source
