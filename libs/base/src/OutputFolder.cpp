#include <fcntl.h>
#include <omnimapper/base/AtomicFile.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/base/OutputFolder.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <thread>
#include <vector>

namespace omnimapper::base {

namespace fs = std::filesystem;

namespace {

const char kHidden[] = ".omnimapper", kStaged[] = "staged", kGrowing[] = "growing", kLock[] = "lock";
// Disk space that is reserved for the record of the commit and for the names of the moved files.
const char kReserve[] = "reserve";
constexpr off_t kReservedBytes = 64 * 1024;
// Lists of the files of the run, and of those of a new run that have not all been moved to their places.
const char kFiles[] = "files", kCommit[] = "commit";
const char kMap[] = "map.omnimap";
// Begins a line of the record with the name of a file that no run wrote.
const char kForeign[] = "~ ";
const char kFirstLine[] = "files of a run of OmniMapper, 1";

using FileList = std::map<std::string, std::uint64_t>;  // file size by path in the folder

[[noreturn]] void fail(const std::string& folder, const std::string& reason,
                       ExitCode code = ExitCode::unwritable_output) {
  throw Error(code, folder + ": " + reason);
}

// Reads a list with a line for each file: size, path. Empty if there is no list or it has another format.
FileList readList(const fs::path& path) {
  FileList files;
  std::ifstream in(path);
  std::string line;
  if (!std::getline(in, line) || line != kFirstLine) return files;
  while (std::getline(in, line)) {
    std::istringstream words(line);
    std::uint64_t size = 0;
    std::string name;
    if (!(words >> size) || words.get() != ' ' || !std::getline(words, name)) continue;
    const fs::path relative(name);
    const bool leaves = relative.is_absolute() || std::find(relative.begin(), relative.end(), "..") != relative.end();
    if (!leaves && *relative.begin() != kHidden) files.emplace(name, size);
  }
  return files;
}

FileList stagedFiles(const std::string& staging) {
  FileList files;
  for (const auto& entry : fs::recursive_directory_iterator(staging)) {
    if (entry.is_regular_file()) files.emplace(entry.path().lexically_relative(staging).string(), entry.file_size());
  }
  return files;
}

// Whether a file is unchanged since its list was written.
bool isAsWritten(const fs::path& file, std::uint64_t size, const fs::path& list) {
  struct stat status {
  }, of_list{};
  if (::lstat(file.c_str(), &status) != 0 || ::stat(list.c_str(), &of_list) != 0) return false;
  const auto time = [](const struct stat& of) { return std::pair(of.st_mtim.tv_sec, of.st_mtim.tv_nsec); };
  return S_ISREG(status.st_mode) && static_cast<std::uint64_t>(status.st_size) == size && time(status) <= time(of_list);
}

// Removes empty folders, from `folder` up to `top`.
void removeEmptyFolders(fs::path folder, const fs::path& top) {
  std::error_code error;
  for (; folder != top && fs::remove(folder, error); folder = folder.parent_path()) continue;
}

// Whether a folder between `top` and the file is a link, so that the file would lie elsewhere.
bool isBehindLink(const fs::path& top, const fs::path& name) {
  fs::path at = top;
  const fs::path folders = name.parent_path();
  return std::any_of(folders.begin(), folders.end(), [&](const fs::path& part) { return fs::is_symlink(at /= part); });
}

// Why a file of a run cannot be moved to its place; empty if it can. Folders that do not exist yet are no obstacle.
std::string whyNotAt(const fs::path& top, const fs::path& name) {
  if (name.string().find('\n') != std::string::npos) return "no file of a run may have a line break in its name";
  if (fs::is_directory(top / name)) return "is a folder, but this run writes a file of that name; move it away";
  struct stat here {
  }, there{};
  if (::stat(top.c_str(), &here) != 0) return std::strerror(errno);
  fs::path at = top;
  for (const fs::path& part : name.parent_path()) {
    at /= part;
    if (::lstat(at.c_str(), &there) != 0) break;
    if (!S_ISDIR(there.st_mode))
      return at.string() + " is not a folder, but this run needs a folder of that name; move it away";
    if (here.st_dev != there.st_dev) return at.string() + " is on another file system; choose another folder with -o";
    if (::access(at.c_str(), W_OK | X_OK) != 0) return at.string() + " is not writable; change its permissions";
  }
  return "";
}

// The names that the record of a commit marks with a tilde: files that no run wrote.
std::set<std::string> readForeign(const fs::path& note) {
  std::set<std::string> names;
  std::ifstream in(note);
  for (std::string line; std::getline(in, line);)
    if (line.rfind(kForeign, 0) == 0) names.insert(line.substr(sizeof kForeign - 1));
  return names;
}

// Renames a file that no run wrote and that is in the place of a new one: a tilde is appended, as editors do for
// backups.
void setAside(const fs::path& file) {
  fs::path other = file.string() + "~";
  for (int n = 2; fs::exists(fs::symlink_status(other)); ++n) other = file.string() + "~" + std::to_string(n);
  fs::rename(file, other);
}

// Finishes a recorded commit. It can be interrupted and repeated at any point.
void finishCommit(const fs::path& folder) {
  const fs::path hidden = folder / kHidden, staged = hidden / kStaged;
  if (!fs::exists(hidden / kCommit)) return;
  const FileList before = readList(hidden / kFiles), after = readList(hidden / kCommit);
  const auto foreign = readForeign(hidden / kCommit);
  for (const auto& [name, size] : after) {
    if (!fs::exists(staged / name) || isBehindLink(folder, name)) continue;
    fs::create_directories((folder / name).parent_path());
    if (foreign.count(name) > 0 && fs::exists(fs::symlink_status(folder / name))) setAside(folder / name);
    fs::rename(staged / name, folder / name);
  }
  for (const auto& [name, size] : before) {
    if (after.count(name) > 0 || isBehindLink(folder, name) || !isAsWritten(folder / name, size, hidden / kFiles))
      continue;
    fs::remove(folder / name);
    removeEmptyFolders((folder / name).parent_path(), folder);
  }
  fs::rename(hidden / kCommit, hidden / kFiles);
}

// Locks a folder. Returns the descriptor, or -1 with errno. A lock file that its owner has removed in the meantime is
// not valid.
int takeLock(const fs::path& hidden) {
  const std::string path = hidden / kLock;
  for (;;) {
    const int lock = ::open(path.c_str(), O_CREAT | O_RDWR | O_CLOEXEC, 0666);
    if (lock < 0) return -1;
    const bool is_free =
        ::flock(lock, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK;  // some file systems have no locks
    struct stat ours {
    }, there{};
    const bool is_there = ::fstat(lock, &ours) == 0 && ::stat(path.c_str(), &there) == 0 && ours.st_ino == there.st_ino;
    if (is_free && is_there) return lock;
    ::close(lock);
    if (!is_free) return errno = EWOULDBLOCK, -1;
  }
}

}  // namespace

OutputFolder::OutputFolder(const std::string& folder)
    : folder_(folder),
      hidden_(folder + "/" + kHidden),
      staging_(hidden_ + "/" + kStaged),
      growing_(hidden_ + "/" + kGrowing) {}

OutputFolder::~OutputFolder() {
  release();
}

void OutputFolder::release() {
  if (lock_ < 0) return;
  std::error_code ignored;
  const fs::path hidden(hidden_);
  fs::remove_all(growing_, ignored);
  if (!fs::exists(hidden / kCommit, ignored)) {
    fs::remove_all(staging_, ignored);
    fs::remove(hidden / kReserve, ignored);
    if (!fs::exists(hidden / kFiles, ignored)) fs::remove_all(hidden, ignored);
  }
  if (is_new_) fs::remove(folder_, ignored);  // fails if it is not empty
  ::flock(lock_, LOCK_UN);                    // a child process may still have the descriptor
  ::close(lock_);
  lock_ = -1;
}

void OutputFolder::open() {
  lock();
  const std::string reserve = hidden_ + "/" + kReserve;
  const int file = ::open(reserve.c_str(), O_CREAT | O_WRONLY | O_CLOEXEC, 0666);
  // File systems that cannot reserve space, and limits set by the user, do not count as a full disk.
  const int error = file < 0 ? errno : ::posix_fallocate(file, 0, kReservedBytes);
  if (file >= 0) ::close(file);
  if (error == ENOSPC || error == EDQUOT)
    fail(
        folder_,
        std::string("there is no room for outputs (") + std::strerror(error) + "). Free some or choose another folder.",
        ExitCode::disk_full);
  if (file < 0) fail(reserve, std::string("cannot be written (") + std::strerror(error) + ")");
}

void OutputFolder::lock() {
  std::error_code error;
  is_new_ = !fs::exists(folder_, error);
  makeWritableFolder(folder_);
  makeWritableFolder(hidden_);
  lock_ = takeLock(hidden_);
  if (lock_ < 0 && errno == EWOULDBLOCK)
    fail(folder_, "another run is writing into this folder; wait for its end, or choose another folder with -o");
  if (lock_ < 0) fail(folder_, std::string("cannot be locked (") + std::strerror(errno) + ")");
  try {
    finishCommit(folder_);
    fs::remove_all(staging_);
    if (!fs::is_directory(fs::symlink_status(growing_))) fs::remove_all(growing_);
    if (fs::exists(growing_))
      for (const auto& entry : fs::directory_iterator(growing_)) fs::remove_all(entry.path());
  } catch (const fs::filesystem_error& error) {
    fail(folder_, std::string("the unfinished outputs of a killed run cannot be completed (") + error.what() + ")");
  }
  makeWritableFolder(staging_);
}

bool OutputFolder::isCommitted() const {
  std::error_code error;
  return fs::exists(fs::path(hidden_) / kCommit, error);
}

bool OutputFolder::holdsRun() const {
  std::error_code error;
  return fs::exists(fs::path(hidden_) / kFiles, error) || fs::exists(fs::path(folder_) / kMap, error);
}

void OutputFolder::commit() {
  try {
    fs::remove(fs::path(hidden_) / kReserve);
    FileList files = stagedFiles(staging_);
    for (const auto& [name, size] : files) {
      const fs::path target = fs::path(folder_) / name;
      if (const auto reason = whyNotAt(folder_, name); !reason.empty()) fail(target, reason);
      refuseToReplaceKeptInput(target);
    }
    const FileList before = readList(fs::path(hidden_) / kFiles);
    // Files beside a map without a list are taken for outputs of a run.
    const bool is_unlisted_run = before.empty() && fs::exists(fs::path(folder_) / kMap);
    std::vector<std::string> foreign;
    for (const auto& [name, size] : files) {
      const bool is_there = fs::exists(fs::symlink_status(fs::path(folder_) / name));
      if (is_there && !is_unlisted_run && before.count(name) == 0) foreign.push_back(name);
    }
    // Files that the run read are kept, too.
    for (const auto& [name, size] : before) {
      const fs::path file = fs::path(folder_) / name;
      if ((kept_.count(name) > 0 || isKeptInput(file)) && fs::is_regular_file(file))
        files.try_emplace(name, fs::file_size(file));
    }
    // This is the decisive step: before it the old files are valid, after it the new ones.
    writeFile(hidden_ + "/" + kCommit, [&](std::ostream& out) {
      out << kFirstLine << "\n";
      for (const auto& [name, size] : files) out << size << " " << name << "\n";
      for (const auto& name : foreign) out << kForeign << name << "\n";
    });
  } catch (const fs::filesystem_error& error) {
    fail(folder_, std::string("the outputs cannot be moved there (") + error.what() + ")");
  }
  try {
    finishCommit(folder_);
  } catch (const fs::filesystem_error& error) {
    fail(folder_, std::string("the new outputs are valid, but some are not in their places yet (") + error.what() +
                      "); once this is solved, the next run or reader moves them");
  }
}

void OutputFolder::commitInto(const std::string& name) {
  OutputFolder inner(folder_ + "/" + name);
  try {
    fs::remove(fs::path(hidden_) / kReserve);
    inner.lock();
    for (const auto& entry : fs::directory_iterator(staging_))
      fs::rename(entry.path(), fs::path(inner.staging()) / entry.path().filename());
  } catch (const fs::filesystem_error& error) {
    fail(inner.folder(), std::string("the outputs cannot be moved there (") + error.what() + ")");
  }
  inner.commit();
}

void OutputFolder::removeInner(const std::string& name) {
  const fs::path folder = fs::path(folder_) / name;
  std::error_code none;
  if (!fs::exists(folder / kHidden, none)) return;
  OutputFolder inner(folder);
  inner.lock();
  try {
    for (const auto& [file, size] : readList(folder / kHidden / kFiles)) {
      if (isBehindLink(folder, file) || !isAsWritten(folder / file, size, folder / kHidden / kFiles)) continue;
      fs::remove(folder / file);
      removeEmptyFolders((folder / file).parent_path(), folder);
    }
    fs::remove_all(folder / kHidden);
    std::error_code has_more;
    fs::remove(folder, has_more);
  } catch (const fs::filesystem_error& error) {
    fail(folder, std::string("the results of an older run cannot be removed (") + error.what() + ")");
  }
}

std::vector<std::string> OutputFolder::foreignFiles() const {
  std::vector<std::string> names;
  const FileList files = readList(fs::path(hidden_) / kFiles);
  std::error_code error;
  for (fs::directory_iterator it(folder_, error), end; !error && it != end; it.increment(error)) {
    const auto& entry = *it;
    const std::string name = entry.path().filename();
    const auto inside = files.lower_bound(name + "/");
    const bool is_of_run =
        files.count(name) > 0 || (inside != files.end() && inside->first.compare(0, name.size() + 1, name + "/") == 0);
    if (name != kHidden && !is_of_run && !fs::exists(entry.path() / kHidden, error)) names.push_back(name);
  }
  std::sort(names.begin(), names.end());
  return names;
}

std::string OutputFolder::asTheUserSees(std::string message) const {
  for (std::size_t at = 0; (at = message.find(staging_, at)) != std::string::npos; at += folder_.size())
    message.replace(at, staging_.size(), folder_);
  return message;
}

bool isBeingWritten(const std::string& folder) {
  const fs::path lock = fs::path(folder) / kHidden / kLock;
  const int file = ::open(lock.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) return false;
  const bool is_locked = ::flock(file, LOCK_SH | LOCK_NB) != 0 && errno == EWOULDBLOCK;
  ::close(file);
  return is_locked;
}

std::string committedPath(const std::string& path) {
  const fs::path file(path), folder = file.has_parent_path() ? file.parent_path() : ".", hidden = folder / kHidden;
  std::error_code error;
  // A commit that another user recorded is not finished on behalf of this user.
  struct stat note {};
  if (::lstat((hidden / kCommit).c_str(), &note) != 0 || note.st_uid != ::geteuid() || fs::is_symlink(hidden, error) ||
      fs::is_symlink(hidden / kStaged, error))
    return path;
  // The process that holds the lock is about to finish the commit.
  for (int tries = 0; tries < 1000 && fs::exists(hidden / kCommit, error); ++tries) {
    const int lock = takeLock(hidden);
    if (lock < 0 && errno != EWOULDBLOCK) {
      const fs::path staged = hidden / kStaged / file.filename();
      return fs::exists(staged, error) ? staged.string() : path;
    }
    if (lock < 0) {
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
      continue;
    }
    try {
      finishCommit(folder);
    } catch (const fs::filesystem_error&) {
    }
    ::close(lock);
    const fs::path staged = hidden / kStaged / file.filename();
    if (fs::exists(hidden / kCommit, error) && fs::exists(staged, error)) return staged.string();
    break;
  }
  return path;
}

}  // namespace omnimapper::base
