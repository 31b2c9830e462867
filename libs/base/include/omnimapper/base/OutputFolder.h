#pragma once

#include <set>
#include <string>
#include <vector>

namespace omnimapper::base {

/// The folder of a run's outputs, whose files are replaced all together or not at all. They are written into a staging
/// folder inside of it. commit() first records, in one step, that the new files are valid, and then moves them to their
/// places. If the process is killed before this record, nothing has changed; if after it, the next program that opens
/// the folder for writing, or one of its files with openInput(), finishes the move.
///
/// A hidden folder ".omnimapper" holds the staging folder, the lock, and the list of the run's files, by which a later
/// run distinguishes them from files of others. Those are kept; if a new file has the same name, the old one is renamed
/// to NAME~.
class OutputFolder {
 public:
  /// Does not access the disk yet.
  explicit OutputFolder(const std::string& folder);
  /// Removes files that were not committed, and the folder if open() created it and it is empty.
  ~OutputFolder();
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

  /// Creates the folder and its staging folder and locks it for the lifetime of this object. Throws
  /// Error(unwritable_output) if that fails or another process holds the lock, and Error(disk_full) if there is not
  /// even room for the record of a commit.
  void open();
  /// The folder to write the files into; it exists after open(). Folders in it become folders of the same name.
  const std::string& staging() const { return staging_; }
  const std::string& folder() const { return folder_; }
  /// Keeps a file of the previous run, given by its path in the folder, unless a new file has its name.
  void keep(const std::string& name) { kept_.insert(name); }
  /// Whether the folder has files of a run; if it has no list of files, whether it has a map.
  bool holdsRun() const;

  /// Replaces the files of the previous run by the staged ones. Files of that run that were changed by others since are
  /// kept unless a new file has their name, and so are files protected by InputsKept. Throws Error(unwritable_output)
  /// or Error(disk_full), and Error(command_line) if a protected file would be replaced; isCommitted() then says
  /// whether the new files are valid nevertheless.
  void commit();
  /// Whether a commit was recorded but is not finished.
  bool isCommitted() const;
  /// Moves the staged files into a subfolder, whose files it replaces as commit() does; the files of this folder are
  /// kept.
  void commitInto(const std::string& name);
  /// Removes the files that commitInto() left in that subfolder, if any. Files of others are kept.
  void removeInner(const std::string& name);
  /// Sorted names of the files and folders in this folder that no run wrote.
  std::vector<std::string> foreignFiles() const;
  /// A message about a staged file, with its final path instead of the staged one.
  std::string asTheUserSees(std::string message) const;

 private:
  void lock();

  std::string folder_, hidden_, staging_;
  std::set<std::string> kept_;
  int lock_ = -1;
  bool is_new_ = false;
};

/// The current path of a file that a run wrote directly in its folder. If a commit of the same user was killed, it is
/// finished first; if the folder is not writable, the path is that of the staged file. Any other path is returned
/// unchanged.
std::string committedPath(const std::string& path);

}  // namespace omnimapper::base
