#include "unpackedFile.h"

#include <fcntl.h>
#include <omnimapper/source/refuse.h>
#include <sys/statvfs.h>
#include <unistd.h>
#include <zstd.h>

#include <cerrno>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <memory>
#include <vector>

#include "RandomFile.h"

namespace omnimapper::ros {

namespace {

std::string temporaryName() {
  return (std::filesystem::temp_directory_path() / "omnimapper-log-XXXXXX").string();
}

int temporaryFile(std::string& name, const std::string& path) {
  const int file = ::mkostemp(name.data(), O_CLOEXEC);
  if (file < 0) source::refuse(path, "cannot be unpacked into " + name + ": " + std::strerror(errno));
  return file;
}

std::uint64_t halfOfFreeSpace(int file) {
  struct statvfs space {};
  return ::fstatvfs(file, &space) == 0 ? std::uint64_t{space.f_bavail} * space.f_frsize / 2 : 0;
}

void writeAll(int file, const char* bytes, std::size_t count, const std::string& path) {
  while (count > 0) {
    const auto done = ::write(file, bytes, count);
    if (done < 0 && errno == EINTR) continue;
    if (done <= 0) source::refuse(path, std::string("cannot be unpacked: ") + std::strerror(errno));
    bytes += done;
    count -= static_cast<std::size_t>(done);
  }
}

// Unpacks until the end, or until the file is damaged or cut: what is before that is read.
Damage unpack(const std::string& path, int file) {
  const RandomFile packed(path);
  const std::unique_ptr<ZSTD_DStream, size_t (*)(ZSTD_DStream*)> stream(ZSTD_createDStream(), ZSTD_freeDStream);
  std::vector<char> out(ZSTD_DStreamOutSize());
  std::uint64_t written = 0, most = halfOfFreeSpace(file);
  constexpr std::uint64_t kStep = std::uint64_t{1} << 20;
  bool is_in_frame = false;
  for (std::uint64_t at = 0; at < packed.size();) {
    const std::string bytes = packed.read(at, kStep);
    if (bytes.empty()) return {false, "cannot be read to its end"};
    at += bytes.size();
    ZSTD_inBuffer in{bytes.data(), bytes.size(), 0};
    bool is_full = true;  // the buffer of the last step, so that more may come
    while (in.pos < in.size || is_full) {
      ZSTD_outBuffer to{out.data(), out.size(), 0};
      const std::size_t before = in.pos, left = ZSTD_decompressStream(stream.get(), &to, &in);
      if (ZSTD_isError(left))
        return {false, std::string("has damaged data (Zstandard: ") + ZSTD_getErrorName(left) + ")"};
      if (in.pos > before || to.pos > 0) is_in_frame = left != 0;
      written += to.pos;
      if (written > most)
        source::refuse(path,
                       "needs more room than half of what is free in the temporary folder; unpack it with zstd -d");
      writeAll(file, out.data(), to.pos, path);
      is_full = to.pos == out.size();
    }
  }
  return is_in_frame ? Damage{true, "ends in the middle of its compressed data"} : Damage{};
}

}  // namespace

UnpackedFile::UnpackedFile(const std::string& path) : name_(temporaryName()), file_(temporaryFile(name_, path)) {
  try {
    damage_ = unpack(path, file_);
  } catch (...) {
    remove();
    throw;
  }
}

UnpackedFile::~UnpackedFile() {
  remove();
}

void UnpackedFile::remove() {
  ::close(file_);
  ::unlink(name_.c_str());
}

}  // namespace omnimapper::ros
