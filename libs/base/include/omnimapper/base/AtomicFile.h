#pragma once

#include <functional>
#include <iosfwd>
#include <string>
#include <vector>

namespace omnimapper::base {

/// Creates the folder and its parents if they are missing. Throws Error(unwritable_output) if a folder cannot be
/// created, or if nothing can be written into it.
void makeWritableFolder(const std::string& folder);

/// Writes a file so that at any time `path` holds either its old content or the whole new one. `save` is given the path
/// of a temporary file (same folder, same extension) and writes this file, which is then synced and renamed to `path`.
/// Temporary files of killed processes that were writing `path` are removed first. Throws Error(unwritable_output) if
/// the folder is missing or not writable. If writing fails, the temporary file is removed and Error(disk_full) is
/// thrown with the system's reason.
void replaceFile(const std::string& path, const std::function<void(const std::string& temporary_path)>& save);

/// As replaceFile(), but `write` is given a stream instead of a path. A failed stream counts as a failed write.
void writeFile(const std::string& path, const std::function<void(std::ostream&)>& write);

/// Throws Error(command_line) if `output` is one of the input files, even if another path or a link leads to it.
void refuseToReplaceInput(const std::string& output, const std::vector<std::string>& inputs);

/// While an object of this class exists, replaceFile(), writeFile() and refuseToReplaceKeptInput() refuse to replace
/// the files `inputs`: they throw Error(command_line).
class InputsKept {
 public:
  explicit InputsKept(const std::vector<std::string>& inputs);
  ~InputsKept();
  InputsKept(const InputsKept&) = delete;
  InputsKept& operator=(const InputsKept&) = delete;

 private:
  std::vector<std::string> before_;
};

/// Whether an InputsKept protects the file `path`.
bool isKeptInput(const std::string& path);
/// Throws Error(command_line) if an InputsKept protects the file `output`.
void refuseToReplaceKeptInput(const std::string& output);

}  // namespace omnimapper::base
