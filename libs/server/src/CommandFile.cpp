#include <fcntl.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/obs/CommandTable.h>
#include <omnimapper/server/CommandFile.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <sstream>

namespace omnimapper::server {

namespace {

/// A command later than the clock by more than this is not given [s]; the driver CCommandFile rejects it if it is 10 s.
constexpr double kMostAhead = 5;

/// The stamp with which a row begins; that of no time if it begins with none.
base::Stamp stampOfRow(const std::string& row) {
  const auto comma = row.find(',');
  if (comma == std::string::npos) return {};
  try {
    const auto stamp = base::parseUnix(row.substr(0, comma));
    return base::isValid(stamp) ? stamp : base::Stamp();
  } catch (const base::Error&) {
    return {};
  }
}

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
  bool isCutOff() const { return !isEmpty() && bytesAt(size_ - 1, 1) != "\n"; }
  /// Whether the first line names the columns of the rows that are written here.
  bool hasColumns() const {
    const std::string columns = obs::kCommandColumns, first = bytesAt(0, columns.size() + 1);
    return first == columns || first == columns + "\n";
  }
  /// The latest stamp of the last rows.
  base::Stamp lastStamp() const {
    constexpr off_t kMost = 16384;
    const off_t begin = std::max<off_t>(0, size_ - kMost);
    std::istringstream lines(bytesAt(begin, static_cast<std::size_t>(size_ - begin)));
    std::string line;
    std::getline(lines, line);  // the columns, or a part of a row
    base::Stamp last;
    while (std::getline(lines, line)) last = std::max(last, stampOfRow(line));
    return last;
  }
  /// Writes all or nothing.
  void add(const std::string& bytes) {
    const ssize_t written = ::write(file_, bytes.data(), bytes.size());
    std::string why = written < 0 ? std::strerror(errno) : "";
    if (why.empty() && written < static_cast<ssize_t>(bytes.size())) why = "there is no room for all of it";
    if (why.empty() && ::fsync(file_) != 0) why = std::strerror(errno);
    if (why.empty()) return;
    if (::ftruncate(file_, size_) != 0) why += "; a part of it is in the table";
    throw base::Error(base::ExitCode::disk_full, path_ + ": the command cannot be written: " + why);
  }

 private:
  std::string bytesAt(off_t position, std::size_t count) const {
    std::string bytes(count, '\0');
    const ssize_t read = ::pread(file_, bytes.data(), bytes.size(), position);
    bytes.resize(static_cast<std::size_t>(std::max<ssize_t>(0, read)));
    return bytes;
  }

  const std::string& path_;
  int file_;
  off_t size_ = 0;  // [bytes] before something is added
};

}  // namespace

void CommandFile::append(obs::CObservationCommand command) {
  Appending file(path_);
  if (!file.isEmpty() && !file.hasColumns())
    throw base::Error(base::ExitCode::unwritable_output,
                      path_ + ": is no table of commands that this program began, for its first line is another one; " +
                          "name a new file");
  const double ahead = base::secondsBetween(command.timestamp, file.lastStamp());
  if (ahead > kMostAhead && command.kind != obs::CommandKind::stop)
    throw base::Error(
        base::ExitCode::unwritable_output,
        "the clock of this machine was set back since the last command, so the run would reject this one; "
        "try again in " +
            std::to_string(static_cast<long>(ahead)) + " s");
  command.timestamp = std::max(command.timestamp, file.lastStamp() + base::Duration(1));
  std::string bytes = file.isCutOff() ? "\n" : "";
  if (file.isEmpty()) bytes = std::string(obs::kCommandColumns) + "\n";
  file.add(bytes + obs::commandRow(command) + "\n");
}

}  // namespace omnimapper::server
