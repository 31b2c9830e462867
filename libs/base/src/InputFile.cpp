#include <omnimapper/base/Error.h>
#include <omnimapper/base/InputFile.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <sstream>

namespace omnimapper::base {

std::ifstream openInput(const std::string& path) {
  std::error_code none;
  const auto status = std::filesystem::status(path, none);
  if (std::filesystem::is_directory(status)) {
    throw Error(ExitCode::unreadable_input, path + ": is a folder; name a file in it");
  }
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status)) {
    throw Error(ExitCode::unreadable_input, path + ": is a pipe or a device; copy what it gives into a file");
  }
  std::ifstream in(path, std::ios::binary);
  if (!in) {
    throw Error(ExitCode::unreadable_input,
                path + ": cannot be opened: " + std::strerror(errno) + "; is the path right?");
  }
  return in;
}

std::string readInput(const std::string& path) {
  auto in = openInput(path);
  std::ostringstream content;
  content << in.rdbuf();
  if (in.bad()) throw Error(ExitCode::damaged_input, path + ": cannot be read to its end; is the disk whole?");
  return std::move(content).str();
}

}  // namespace omnimapper::base
