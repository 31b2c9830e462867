#include <fcntl.h>
#include <omnimapper/base/AtomicFile.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/base/Exceptions.h>
#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <mutex>
#include <vector>

namespace omnimapper::base {

namespace fs = std::filesystem;

namespace {

// Syncs a file or folder; folders that some file systems cannot sync count as synced.
bool syncPath(const std::string& path) {
  const int fd = ::open(path.c_str(), O_RDONLY);
  if (fd < 0) return false;
  const bool synced = ::fsync(fd) == 0 || errno == EINVAL;
  ::close(fd);
  return synced;
}

// The reason why nothing can be written into a folder; empty if it is writable.
std::string whyUnwritable(const std::string& folder) {
  std::error_code none;
  if (!fs::exists(folder, none)) return "there is no such folder";
  if (!fs::is_directory(folder, none)) return "it is a file";
  return ::access(folder.c_str(), W_OK | X_OK) == 0 ? "" : std::strerror(errno);
}

struct KeptInputs {
  std::mutex mutex;
  std::vector<std::string> paths;
};
KeptInputs& keptInputs() {
  static KeptInputs kept;
  return kept;
}

std::string folderOf(const fs::path& target) {
  return target.has_parent_path() ? target.parent_path().string() : ".";
}

[[noreturn]] void failForFolder(const std::string& path, const std::string& which, const std::string& reason) {
  throw Error(ExitCode::unwritable_output, path + ": cannot write into " + which + " folder (" + reason +
                                               "); choose another or change its permissions.");
}

[[noreturn]] void failWrite(const std::string& path, const std::string& temporary, const std::string& reason) {
  std::error_code ignored;
  fs::remove(temporary, ignored);
  const bool is_new = !fs::exists(path, ignored);
  throw Error(ExitCode::disk_full, path + ": cannot be written (" + reason + ")" +
                                       (is_new ? "" : "; its previous content is kept") +
                                       ". Free some room or choose another folder.");
}

// Prefix of the file that is written before it replaces `target`: "map.tmp123.omnimap" for process 123. The extension
// stays last, because several writers choose their format by it.
std::string temporaryPrefix(const fs::path& target) {
  return target.stem().string() + ".tmp";
}
fs::path temporaryOf(const fs::path& target) {
  return target.parent_path() / (temporaryPrefix(target) + std::to_string(::getpid()) + target.extension().string());
}

// Creates the temporary file empty. Anything else with its name, such as a link, is removed and not written through.
// Its time is 1970 until something is written.
void reserve(const std::string& temporary) {
  constexpr int kTries = 3;
  for (int i = 0; i < kTries; ++i) {
    ::unlink(temporary.c_str());
    const int fd = ::open(temporary.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, 0666);
    if (fd >= 0) {
      const timespec times[2] = {{0, 0}, {0, 0}};
      ::futimens(fd, times);
      ::close(fd);
      return;
    }
    if (errno != EEXIST) break;
  }
  throw std::runtime_error(std::strerror(errno));
}

bool isUnwritten(const std::string& temporary) {
  struct stat status {};
  return ::stat(temporary.c_str(), &status) != 0 || (status.st_size == 0 && status.st_mtim.tv_sec == 0);
}

// Removes temporary files of processes that were killed while they wrote `target`.
void removeLeftovers(const fs::path& target) {
  const std::string prefix = temporaryPrefix(target), end = target.extension().string();
  const fs::path folder = folderOf(target);
  std::error_code ignored;
  std::vector<fs::path> left;
  for (fs::directory_iterator entry(folder, ignored), last; !ignored && entry != last; entry.increment(ignored)) {
    const std::string name = entry->path().filename().string();
    if (name.size() <= prefix.size() + end.size() || name.compare(0, prefix.size(), prefix) != 0) continue;
    if (name.compare(name.size() - end.size(), end.size(), end) != 0) continue;
    pid_t writer = 0;
    const char* digits_end = name.data() + name.size() - end.size();
    const auto parsed = std::from_chars(name.data() + prefix.size(), digits_end, writer);
    if (parsed.ec != std::errc() || parsed.ptr != digits_end || writer <= 0) continue;
    if (::kill(writer, 0) != 0 && errno == ESRCH) left.push_back(entry->path());
  }
  for (const auto& path : left) fs::remove(path, ignored);
}

}  // namespace

void makeWritableFolder(const std::string& folder) {
  std::error_code error;
  if (fs::exists(folder, error) && !fs::is_directory(folder, error))
    throw Error(ExitCode::unwritable_output, folder + ": is a file, but a folder is needed; choose another name.");
  fs::create_directories(folder, error);
  if (error) failForFolder(folder, "this", error.message());
  if (const auto reason = whyUnwritable(folder); !reason.empty()) failForFolder(folder, "this", reason);
}

void replaceFile(const std::string& path, const std::function<void(const std::string&)>& save) {
  refuseToReplaceKeptInput(path);
  const fs::path target(path);
  std::error_code none;
  if (fs::is_directory(target, none))
    throw Error(ExitCode::unwritable_output, path + ": is a folder; name a file in it to write.");
  if (const auto reason = whyUnwritable(folderOf(target)); !reason.empty()) failForFolder(path, "its", reason);
  const std::string temporary = temporaryOf(target).string();
  removeLeftovers(target);
  try {
    reserve(temporary);
    errno = 0;
    save(temporary);
  } catch (const Error&) {
    std::error_code ignored;
    fs::remove(temporary, ignored);
    throw;
  } catch (const std::exception& error) {
    failWrite(path, temporary, sentenceOf(error));
  }
  if (isUnwritten(temporary)) failWrite(path, temporary, "nothing was written");
  if (!syncPath(temporary)) failWrite(path, temporary, std::strerror(errno));
  if (std::rename(temporary.c_str(), path.c_str()) != 0) failWrite(path, temporary, std::strerror(errno));
  syncPath(folderOf(target));
}

void writeFile(const std::string& path, const std::function<void(std::ostream&)>& write) {
  replaceFile(path, [&](const std::string& temporary) {
    std::ofstream out(temporary, std::ios::binary);
    if (!out) throw std::runtime_error(std::strerror(errno));
    write(out);
    out.close();
    if (!out) throw std::runtime_error(errno ? std::strerror(errno) : "the stream failed");
  });
}

InputsKept::InputsKept(const std::vector<std::string>& inputs) {
  const std::lock_guard<std::mutex> lock(keptInputs().mutex);
  auto& paths = keptInputs().paths;
  before_ = paths;
  paths.insert(paths.end(), inputs.begin(), inputs.end());
}

InputsKept::~InputsKept() {
  const std::lock_guard<std::mutex> lock(keptInputs().mutex);
  keptInputs().paths = before_;
}

bool isKeptInput(const std::string& path) {
  const std::lock_guard<std::mutex> lock(keptInputs().mutex);
  return std::any_of(keptInputs().paths.begin(), keptInputs().paths.end(), [&](const std::string& input) {
    std::error_code none;
    return fs::equivalent(input, path, none);
  });
}

void refuseToReplaceKeptInput(const std::string& output) {
  const std::lock_guard<std::mutex> lock(keptInputs().mutex);
  refuseToReplaceInput(output, keptInputs().paths);
}

void refuseToReplaceInput(const std::string& output, const std::vector<std::string>& inputs) {
  for (const auto& input : inputs) {
    std::error_code none;  // a path that does not exist is not the same file
    if (std::filesystem::equivalent(input, output, none)) {
      throw Error(ExitCode::command_line,
                  output + ": is an input and would be replaced; give the output another name (" + input + " is read)");
    }
  }
}

}  // namespace omnimapper::base
