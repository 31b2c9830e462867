#include <mrpt/img/CImage.h>
#include <mrpt/serialization/CArchive.h>
#include <omnimapper/base/AtomicFile.h>
#include <omnimapper/source/CompressedFile.h>
#include <omnimapper/source/RawlogWriter.h>
#include <zlib.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <vector>

namespace omnimapper::source {

namespace {

struct Digest {
  std::uint64_t size = 0;
  uLong crc = crc32(0, nullptr, 0);

  void add(const void* data, std::size_t length) {
    crc = crc32_z(crc, static_cast<const Bytef*>(data), length);
    size += length;
  }
};

std::string systemReason() {
  return errno ? std::strerror(errno) : "for an unknown reason";
}

class GzipArchive : public mrpt::serialization::CArchive {
 public:
  explicit GzipArchive(const std::string& path) : file_(gzopen(path.c_str(), "wb6")) {
    if (!file_) throw std::runtime_error(systemReason());
    gzbuffer(file_, 1 << 17);
  }
  ~GzipArchive() override {
    if (file_) gzclose(file_);
  }
  void close() {
    const int result = gzclose(file_);
    file_ = nullptr;
    if (result != Z_OK) throw std::runtime_error(systemReason());
  }
  const Digest& digest() const { return digest_; }

 protected:
  std::size_t write(const void* data, std::size_t size) override {
    const char* bytes = static_cast<const char*>(data);
    for (std::size_t done = 0; done < size;) {
      const auto chunk = static_cast<unsigned>(std::min<std::size_t>(size - done, 1u << 30));
      if (gzwrite(file_, bytes + done, chunk) != static_cast<int>(chunk)) throw std::runtime_error(systemReason());
      done += chunk;
    }
    digest_.add(data, size);
    return size;
  }
  std::size_t read(void*, std::size_t) override { throw std::logic_error("opened for writing"); }

 private:
  gzFile file_;
  Digest digest_;
};

Digest digestOf(const std::string& path) {
  CompressedFile file(path);
  Digest digest;
  std::vector<char> buffer(1 << 17);
  while (file.ending() == CompressedFile::Ending::open)
    digest.add(buffer.data(), file.read(buffer.data(), buffer.size()));
  if (file.ending() != CompressedFile::Ending::end)
    throw std::runtime_error("it cannot be read back: " + file.problem());
  return digest;
}

}  // namespace

void RawlogWriter::add(const mrpt::obs::CObservation& observation) {
  archive_ << observation;
}

void RawlogWriter::add(const mrpt::obs::CActionCollection& actions, const mrpt::obs::CSensoryFrame& frame) {
  archive_ << actions << frame;
}

void writeRawlog(const std::string& path, const std::function<void(RawlogWriter&)>& fill, ColourImages images) {
  const ImageSettings settings(images);
  base::replaceFile(path, [&](const std::string& temporary) {
    GzipArchive archive(temporary);
    RawlogWriter writer(archive);
    fill(writer);
    archive.close();
    const Digest written = archive.digest(), read = digestOf(temporary);
    if (read.size != written.size || read.crc != written.crc)
      throw std::runtime_error("its content differs from what was written when it is read back");
  });
}

}  // namespace omnimapper::source
