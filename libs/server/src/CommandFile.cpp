#include <fcntl.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/obs/CommandTable.h>
#include <omnimapper/server/CommandFile.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

namespace omnimapper::server {

namespace {

/// A file that is open for appending.
class Appending {
 public:
  explicit Appending(const std::string& path)
      : path_(path), file_(::open(path.c_str(), O_RDWR | O_APPEND | O_CREAT | O_NOFOLLOW | O_CLOEXEC, 0600)) {
    struct stat found {};
    if (file_ < 0 || ::fstat(file_, &found) != 0 || !S_ISREG(found.st_mode)) {
      const std::string why = file_ < 0 ? std::strerror(errno) : "it is no regular file";
      if (file_ >= 0) ::close(file_);
      throw base::Error(base::ExitCode::unwritable_output, path + ": commands cannot be appended: " + why);
    }
    size_ = found.st_size;
  }
  ~Appending() { ::close(file_); }
  Appending(const Appending&) = delete;
  Appending& operator=(const Appending&) = delete;

  bool isEmpty() const { return size_ == 0; }
  /// Whether the last line has no end, because a writer was killed.
  bool isCutOff() const {
    char last = '\n';
    return size_ > 0 && ::pread(file_, &last, 1, size_ - 1) == 1 && last != '\n';
  }
  /// Writes all or nothing.
  void add(const std::string& bytes) {
    const bool is_written = ::write(file_, bytes.data(), bytes.size()) == static_cast<ssize_t>(bytes.size());
    if (is_written && ::fsync(file_) == 0) return;
    const std::string why = std::strerror(errno);
    if (::ftruncate(file_, size_) != 0) size_ = 0;
    throw base::Error(base::ExitCode::disk_full, path_ + ": the command cannot be written: " + why);
  }

 private:
  const std::string& path_;
  int file_;
  off_t size_ = 0;  // [bytes] before something is added
};

}  // namespace

void CommandFile::append(obs::CObservationCommand command) {
  command.timestamp = std::max(command.timestamp, last_ + base::Duration(1));
  Appending file(path_);
  std::string bytes = file.isCutOff() ? "\n" : "";
  if (file.isEmpty()) bytes = std::string(obs::kCommandColumns) + "\n";
  file.add(bytes + obs::commandRow(command) + "\n");
  last_ = command.timestamp;
}

}  // namespace omnimapper::server
