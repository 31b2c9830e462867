#include <omnimapper/base/Error.h>
#include <omnimapper/base/InputFile.h>
#include <omnimapper/base/OutputFolder.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

namespace omnimapper::base {

std::ifstream openInput(const std::string& path, const std::string& kind) {
  std::error_code none;
  const auto status = std::filesystem::status(path, none);
  if (std::filesystem::is_directory(status)) {
    throw Error(ExitCode::unreadable_input, path + ": is a folder and no " + kind);
  }
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status)) {
    throw Error(ExitCode::unreadable_input, path + ": is a pipe or a device and no " + kind);
  }
  const std::string place = committedPath(path);
  errno = 0;
  std::ifstream in(place, std::ios::binary);
  if (!in) {
    throw Error(ExitCode::unreadable_input,
                path + ": this " + kind + " cannot be opened: " + std::strerror(errno) + "; is the path right?");
  }
  return in;
}

std::string readInput(const std::string& path, const std::string& kind) {
  auto in = openInput(path, kind);
  std::string content;
  char part[1 << 16];
  while (in.read(part, sizeof part) || in.gcount() > 0) content.append(part, static_cast<std::size_t>(in.gcount()));
  if (in.bad())
    throw Error(ExitCode::damaged_input,
                path + ": this " + kind + " cannot be read to its end; does the disk have errors?");
  return content;
}

}  // namespace omnimapper::base
