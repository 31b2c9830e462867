#include <fcntl.h>
#include <omnimapper/base/AtomicFile.h>
#include <omnimapper/base/Error.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

namespace omnimapper::base {

namespace fs = std::filesystem;

namespace {

// fsync of a file or folder; what has no sync (some file systems' folders) counts as synced.
bool syncPath(const std::string& path) {
  const int fd = ::open(path.c_str(), O_RDONLY);
  if (fd < 0) return false;
  const bool synced = ::fsync(fd) == 0 || errno == EINVAL;
  ::close(fd);
  return synced;
}

[[noreturn]] void failWrite(const std::string& path, const std::string& temporary, const std::string& reason) {
  std::error_code ignored;
  fs::remove(temporary, ignored);
  throw Error(ExitCode::disk_full, path + ": cannot be written (" + reason +
                                       "); its previous content is kept. Free some room or choose another folder.");
}

}  // namespace

void makeWritableFolder(const std::string& folder) {
  const auto refuse = [&](const std::string& reason) {
    throw Error(ExitCode::unwritable_output, folder + ": cannot write into this folder (" + reason +
                                                 "); choose another with -o or mend its permissions.");
  };
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) refuse(error.message());
  if (!fs::is_directory(folder)) refuse("it is a file");
  if (::access(folder.c_str(), W_OK | X_OK) != 0) refuse(std::strerror(errno));
}

void replaceFile(const std::string& path, const std::function<void(const std::string&)>& save) {
  const fs::path target(path);
  // The extension stays last: several writers choose their format by it.
  const std::string temporary = (target.parent_path() / (target.stem().string() + ".tmp" + std::to_string(::getpid()) +
                                                         target.extension().string()))
                                    .string();
  try {
    errno = 0;
    save(temporary);
  } catch (const std::exception& error) {
    failWrite(path, temporary, error.what());
  }
  if (!fs::exists(temporary)) failWrite(path, temporary, "nothing was written");
  if (!syncPath(temporary)) failWrite(path, temporary, std::strerror(errno));
  if (std::rename(temporary.c_str(), path.c_str()) != 0) failWrite(path, temporary, std::strerror(errno));
  syncPath(target.has_parent_path() ? target.parent_path().string() : ".");
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

}  // namespace omnimapper::base
