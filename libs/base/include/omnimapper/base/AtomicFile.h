#pragma once

#include <functional>
#include <iosfwd>
#include <string>
#include <vector>

namespace omnimapper::base {

/// Creates the folder and its parents. Throws Error(unwritable_output) if that fails or nothing can be written in it.
void makeWritableFolder(const std::string& folder);

/// Writes a file so that at any time `path` holds either its old content or the whole new one: `save` writes to the
/// temporary name that it is given (same folder, same extension), which is then synced and renamed. Temporary files of
/// killed processes that were writing `path` are removed first. Throws Error(unwritable_output) if the folder is
/// missing or not writable, and Error(disk_full) with the system's reason if writing fails; the temporary file is then
/// removed.
void replaceFile(const std::string& path, const std::function<void(const std::string& temporary_path)>& save);

/// The same as replaceFile() with a stream; a failed stream counts as a failed write.
void writeFile(const std::string& path, const std::function<void(std::ostream&)>& write);

/// Throws Error(command_line) if `output` is one of the input files, under any name, link or path.
void refuseToReplaceInput(const std::string& output, const std::vector<std::string>& inputs);

/// While an object of this class exists, replaceFile(), writeFile() and refuseToReplaceKeptInput() refuse to replace
/// these files, as refuseToReplaceInput() does.
class InputsKept {
 public:
  explicit InputsKept(const std::vector<std::string>& inputs);
  ~InputsKept();
  InputsKept(const InputsKept&) = delete;
  InputsKept& operator=(const InputsKept&) = delete;

 private:
  std::vector<std::string> before_;
};

/// Whether an InputsKept protects that file.
bool isKeptInput(const std::string& path);
/// Throws Error(command_line) if an InputsKept protects that file.
void refuseToReplaceKeptInput(const std::string& output);

}  // namespace omnimapper::base
