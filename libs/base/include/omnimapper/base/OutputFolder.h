#pragma once

#include <set>
#include <string>
#include <vector>

namespace omnimapper::base {

/// The folder of a run's outputs, whose files are replaced all together or not at all. They are written into a staging
/// folder inside of it. commit() first notes, in one step, that the new ones count, and then moves them to their
/// places. Who was killed before that note has changed nothing; what was killed after it is finished by whoever next
/// opens the folder for writing, or one of its files with openInput().
///
/// A hidden folder ".omnimapper" holds the staging folder, the lock, and the list of the files of the run, by which a
/// later run tells its own kind from what somebody else put there. That stays, and if a new file has its name it
/// becomes NAME~.
class OutputFolder {
 public:
  /// Touches nothing yet.
  explicit OutputFolder(const std::string& folder);
  /// What was not committed goes, and so does the folder if open() made it and nothing is in it.
  ~OutputFolder();
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

  /// Makes the folder and its staging folder, and locks it until this object goes. Throws Error(unwritable_output) if
  /// that fails, or another process has locked it, and Error(disk_full) if there is not even room to note a commit.
  void open();
  /// Where the files are to be written; there from open() on. Folders in it become folders of the same name.
  const std::string& staging() const { return staging_; }
  const std::string& folder() const { return folder_; }
  /// A file of the run before, by its path in the folder, that commit() is to leave there where no new one has its
  /// name.
  void keep(const std::string& name) { kept_.insert(name); }
  /// Whether a run's files are there already; of a folder from before there were lists, a map.
  bool holdsRun() const;

  /// Replaces the files of the run before by those that were staged. A file of that run which somebody has changed
  /// since stays, unless a new one has its name, and so does what InputsKept protects. Throws Error(unwritable_output),
  /// or Error(disk_full), and, if a protected file would be replaced, Error(command_line); isCommitted() tells whether
  /// the new files count all the same.
  void commit();
  /// Whether a commit has been noted and not wholly done.
  bool isCommitted() const;
  /// Moves what is staged into a folder in this one, whose files it replaces as commit() does; these stay.
  void commitInto(const std::string& name);
  /// Removes what commitInto() left in that folder, if anything. What somebody else put there stays.
  void removeInner(const std::string& name);
  /// Names of what is in the folder and no run made, sorted.
  std::vector<std::string> foreignFiles() const;
  /// A message about a staged file, with the place that it was to have.
  std::string asTheUserSees(std::string message) const;

 private:
  void lock();

  std::string folder_, hidden_, staging_;
  std::set<std::string> kept_;
  int lock_ = -1;
  bool is_new_ = false;
};

/// Where the bytes of a file are that a run wrote directly in its folder: finishes a commit there of the same user if
/// that was killed. If the folder may not be written, that is the staged file. Any other path is given back.
std::string committedPath(const std::string& path);

}  // namespace omnimapper::base
