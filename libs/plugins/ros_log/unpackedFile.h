#pragma once

#include <string>

namespace omnimapper::ros {

/// A file that is compressed with Zstandard as a whole, unpacked into a temporary file without a name, which is gone
/// when the program ends. Chunks are read at any place, which a compressed file does not allow.
class UnpackedFile {
 public:
  /// Throws Error(unreadable_input) if the file is damaged, or larger than the free half of the temporary folder.
  explicit UnpackedFile(const std::string& path);
  ~UnpackedFile();
  UnpackedFile(const UnpackedFile&) = delete;
  UnpackedFile& operator=(const UnpackedFile&) = delete;

  /// Opens the unpacked file, while this object lives; what was opened stays open.
  std::string path() const;

 private:
  int file_;
};

}  // namespace omnimapper::ros
