#pragma once

#include <functional>
#include <iosfwd>
#include <string>
#include <vector>

namespace omnimapper::base {

/// Makes the folder and its parents. Throws Error(unwritable_output) if that fails or nothing can be written in it.
void makeWritableFolder(const std::string& folder);

/// Writes a file so that at any moment `path` holds either its old content or the whole new one: `save` writes to
/// the temporary name it is given (same folder, same extension), which is synced and renamed. What a process left
/// behind that was killed while it wrote `path` is removed first.
/// Throws Error(unwritable_output) for a folder that is not there or may not be written, and Error(disk_full) with the
/// system's reason if anything of it fails; the temporary file is removed then.
void replaceFile(const std::string& path, const std::function<void(const std::string& temporary_path)>& save);

/// The same for text and bytes through a stream; a failed stream counts as a failed write.
void writeFile(const std::string& path, const std::function<void(std::ostream&)>& write);

/// Throws Error(command_line) if `output` is one of the files that are read, by whatever name, link or path.
void refuseToReplaceInput(const std::string& output, const std::vector<std::string>& inputs);

/// While it lives, replaceFile() and writeFile() refuse to replace these files as refuseToReplaceInput() does, and so
/// does refuseToReplaceKeptInput().
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
