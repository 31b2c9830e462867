#pragma once

#include <set>
#include <string>
#include <vector>

namespace omnimapper::base {

/// The folder of a run's outputs, whose files are replaced all together or not at all. The files are written into a
/// staging folder inside the output folder. commit() first records, in one step, that the new files are valid, and then
/// moves them to their places. If the process is killed before this record is written, the old files are unchanged. If
/// it is killed after that, the move is finished by the next program that opens the folder for writing, or that opens
/// one of its files with openInput().
///
/// A hidden folder ".omnimapper" holds the staging folder, the lock, and the list of the run's files. By this list a
/// later run distinguishes the run's files from files of others. Files of others are kept; if a new file has the same
/// name as one of them, the old one is renamed to NAME~.
class OutputFolder {
 public:
  /// Does not access the disk yet.
  explicit OutputFolder(const std::string& folder);
  /// Removes files that were not committed, and also the folder itself if open() created it and it is empty.
  ~OutputFolder();
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

  /// Creates the folder and its staging folder, and locks the folder for the lifetime of this object. Throws
  /// Error(unwritable_output) if a folder cannot be created or another process holds the lock, and Error(disk_full) if
  /// there is not even room for the record of a commit.
  void open();
  /// The folder to write the files into; it exists after open(). A subfolder in it is moved by commit() into folder()
  /// under the same name.
  const std::string& staging() const { return staging_; }
  const std::string& folder() const { return folder_; }
  /// A folder for what is shown of a map while it grows. It is none of the run's files: open() empties it if it exists,
  /// and the destructor removes it.
  const std::string& growing() const { return growing_; }
  /// Lets commit() keep a file of the previous run, given by its path in the folder, unless a new file has the same
  /// path.
  void keep(const std::string& name) { kept_.insert(name); }
  /// Whether the folder has outputs of a run, that is, a list of the run's files or a map.
  bool holdsRun() const;

  /// Replaces the files of the previous run by the staged ones. A file of the previous run that others have changed
  /// since is kept, unless a new file has its name. A file that an InputsKept (AtomicFile.h) protects is always kept.
  /// Throws Error(unwritable_output) or Error(disk_full), and Error(command_line) if a protected file would be
  /// replaced; isCommitted() then says whether the new files are valid nevertheless.
  void commit();
  /// Whether a commit was recorded but is not finished.
  bool isCommitted() const;
  /// What the destructor does, at once: unlocks the folder after a commit, so that others may change its files while
  /// this object goes on to exist. Nothing more can be written then.
  void release();
  /// Moves the staged files into the subfolder `name`, whose files are replaced as by commit(). The files of this
  /// folder are kept.
  void commitInto(const std::string& name);
  /// Removes the files that commitInto() left in the subfolder `name`, if there are any. Files of others are kept.
  void removeInner(const std::string& name);
  /// Sorted names of the files and folders in this folder that no run wrote.
  std::vector<std::string> foreignFiles() const;
  /// A message about a staged file, in which the staged path is replaced by the final one.
  std::string asTheUserSees(std::string message) const;

 private:
  void lock();

  std::string folder_, hidden_, staging_, growing_;
  std::set<std::string> kept_;
  int lock_ = -1;
  bool is_new_ = false;
};

/// Whether a run, of this process or another, has locked the folder and will replace its files. False on a file system
/// without locks.
bool isBeingWritten(const std::string& folder);

/// The current path of a file that a run wrote directly into its folder. A commit of the same user that was interrupted
/// is finished first. If the folder is not writable, so that the commit cannot be finished, the path is that of the
/// staged file. Any other path is returned unchanged.
std::string committedPath(const std::string& path);

}  // namespace omnimapper::base
