#include "RandomFile.h"

#include <fcntl.h>
#include <omnimapper/source/refuse.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

namespace omnimapper::ros {

RandomFile::RandomFile(const std::string& path) : file_(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)) {
  if (file_ < 0) source::refuse(path, std::string(std::strerror(errno)) + "; is the path right?");
  struct stat status {};
  if (::fstat(file_, &status) != 0 || !S_ISREG(status.st_mode)) {
    ::close(file_);
    source::refuse(path, "is no regular file");
  }
  size_ = static_cast<std::uint64_t>(status.st_size);
}

RandomFile::~RandomFile() {
  ::close(file_);
}

std::string RandomFile::read(std::uint64_t offset, std::uint64_t count) const {
  std::string bytes(static_cast<std::size_t>(offset < size_ ? std::min(count, size_ - offset) : 0), '\0');
  std::size_t done = 0;
  while (done < bytes.size()) {
    const auto got = ::pread(file_, bytes.data() + done, bytes.size() - done, static_cast<off_t>(offset + done));
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) break;
    done += static_cast<std::size_t>(got);
  }
  bytes.resize(done);
  return bytes;
}

std::string RandomFile::readSmall(std::uint64_t offset, std::uint64_t count) const {
  constexpr std::uint64_t kBuffer = std::uint64_t{1} << 14;
  if (offset >= size_) return {};
  if (count > kBuffer) return read(offset, count);
  // A damaged file states any offset, so offsets are compared without being added to.
  const bool is_held = offset >= buffer_offset_ && offset - buffer_offset_ <= buffer_.size() &&
                       count <= buffer_.size() - (offset - buffer_offset_);
  if (!is_held) {
    buffer_ = read(offset, kBuffer);
    buffer_offset_ = offset;
  }
  return buffer_.substr(static_cast<std::size_t>(offset - buffer_offset_), static_cast<std::size_t>(count));
}

}  // namespace omnimapper::ros
