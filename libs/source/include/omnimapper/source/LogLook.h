#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace omnimapper::source {

/// What a log looks like before it is opened: its name and its beginning, or the names of what is in its folder. Read
/// once for all formats, and bounded: neither a large file nor a large folder takes long.
struct LogLook {
  static constexpr std::size_t kLongestHead = std::size_t{1} << 16;  ///< [bytes]
  static constexpr std::size_t kMostEntries = 100'000;

  std::string path;
  bool is_folder = false;
  std::string head;                  ///< of a file: its first bytes, uncompressed if it is gzip or bzip2
  std::string problem;               ///< of a file: what is wrong with its compression; empty if nothing is
  std::vector<std::string> entries;  ///< of a folder: names of files and folders in it, sorted

  /// Throws Error(unreadable_input) if there is nothing at `path`, or it cannot be read, or the file is empty.
  static LogLook at(const std::string& path);

  /// Whether the head consists of text; bytes of 128 and above are taken for UTF-8.
  bool isText() const;
  bool headBeginsWith(std::string_view beginning) const;
  bool has(const std::string& entry) const;
  /// The first entry in the order of names that ends so; empty if there is none.
  std::string firstEnding(std::string_view ending) const;
};

}  // namespace omnimapper::source
