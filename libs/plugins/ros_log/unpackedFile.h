#pragma once

#include <string>

#include "Container.h"

namespace omnimapper::ros {

/// A file that is compressed with Zstandard as a whole, unpacked into a temporary file. Chunks are read at any place,
/// which a compressed file does not allow. The temporary file has a name while this object lives, as SQLite opens files
/// by their names; what was opened by then stays open, and its room is free when it is closed.
class UnpackedFile {
 public:
  /// What is before damage is unpacked. Throws Error(unreadable_input) if the file cannot be read, or is larger than
  /// the free half of the temporary folder.
  explicit UnpackedFile(const std::string& path);
  ~UnpackedFile();
  UnpackedFile(const UnpackedFile&) = delete;
  UnpackedFile& operator=(const UnpackedFile&) = delete;

  const std::string& path() const { return name_; }
  /// What is wrong with the compressed file.
  const Damage& damage() const { return damage_; }

 private:
  void remove();

  std::string name_;
  int file_;
  Damage damage_;
};

}  // namespace omnimapper::ros
