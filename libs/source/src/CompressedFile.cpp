
#include <bzlib.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/source/CompressedFile.h>
#include <omnimapper/source/describeInput.h>
#include <omnimapper/source/refuse.h>
#include <sys/stat.h>
#include <zlib.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <vector>

namespace omnimapper::source {

/// Decodes one compressed member after another.
class CompressedFile::Decoder {
 public:
  enum class Step { more, member_end, bad };
  virtual ~Decoder() = default;
  /// Decodes from `in` to `out` and advances both.
  virtual Step decode(const char*& in, std::size_t& in_size, char*& out, std::size_t& out_size) = 0;
  virtual void startMember() = 0;
  /// Whether a member can begin with this byte.
  virtual bool beginsWith(char byte) const = 0;
  /// Why decode() returned Step::bad.
  virtual std::string problem() const = 0;
};

namespace {

class GzipDecoder : public CompressedFile::Decoder {
 public:
  GzipDecoder() { inflateInit2(&stream_, 15 + 16); }  // the largest window, gzip header and check
  ~GzipDecoder() override { inflateEnd(&stream_); }
  void startMember() override { inflateReset(&stream_); }
  bool beginsWith(char byte) const override { return byte == '\x1f'; }
  std::string problem() const override { return std::string("gzip: ") + (stream_.msg ? stream_.msg : "bad data"); }

  Step decode(const char*& in, std::size_t& in_size, char*& out, std::size_t& out_size) override {
    stream_.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(in));
    stream_.avail_in = static_cast<uInt>(in_size);
    stream_.next_out = reinterpret_cast<Bytef*>(out);
    stream_.avail_out = static_cast<uInt>(out_size);
    const int result = inflate(&stream_, Z_NO_FLUSH);
    in += in_size - stream_.avail_in;
    in_size = stream_.avail_in;
    out += out_size - stream_.avail_out;
    out_size = stream_.avail_out;
    if (result == Z_STREAM_END) return Step::member_end;
    return result == Z_OK || result == Z_BUF_ERROR ? Step::more : Step::bad;
  }

 private:
  z_stream stream_{};
};

class Bzip2Decoder : public CompressedFile::Decoder {
 public:
  Bzip2Decoder() { BZ2_bzDecompressInit(&stream_, 0, 0); }
  ~Bzip2Decoder() override { BZ2_bzDecompressEnd(&stream_); }
  void startMember() override {
    BZ2_bzDecompressEnd(&stream_);
    stream_ = {};
    BZ2_bzDecompressInit(&stream_, 0, 0);
  }
  bool beginsWith(char byte) const override { return byte == 'B'; }
  std::string problem() const override { return "bzip2: bad data or checksum"; }

  Step decode(const char*& in, std::size_t& in_size, char*& out, std::size_t& out_size) override {
    stream_.next_in = const_cast<char*>(in);
    stream_.avail_in = static_cast<unsigned>(in_size);
    stream_.next_out = out;
    stream_.avail_out = static_cast<unsigned>(out_size);
    const int result = BZ2_bzDecompress(&stream_);
    in += in_size - stream_.avail_in;
    in_size = stream_.avail_in;
    out += out_size - stream_.avail_out;
    out_size = stream_.avail_out;
    if (result == BZ_STREAM_END) return Step::member_end;
    return result == BZ_OK ? Step::more : Step::bad;
  }

 private:
  bz_stream stream_{};
};

constexpr std::size_t kChunk = 1 << 16;

}  // namespace

struct CompressedFile::State {
  std::string path;
  std::FILE* file = nullptr;
  std::uint64_t size = 0;        // of the file on disk
  std::uint64_t disk_bytes = 0;  // read from disk
  std::vector<char> chunk = std::vector<char>(kChunk);
  const char* in = nullptr;  // what is left of the chunk
  std::size_t in_size = 0;
  std::unique_ptr<Decoder> decoder;  // null: plain
  bool in_member = true;
  std::uint64_t position = 0;
  Ending ending = Ending::open;
  std::string problem;

  ~State() {
    if (file) std::fclose(file);
  }

  // Returns false at the end of the file on disk, and where it cannot be read.
  bool refill() {
    if (in_size > 0) return true;
    in = chunk.data();
    in_size = std::fread(chunk.data(), 1, chunk.size(), file);
    disk_bytes += in_size;
    if (in_size > 0) return true;
    if (std::ferror(file)) {
      end(Ending::corrupt, std::strerror(errno));
    } else if (decoder && in_member) {
      end(Ending::truncated, "the compressed data end too early");
    } else {
      end(Ending::end, "");
    }
    return false;
  }

  void end(Ending how, const std::string& why) {
    ending = how;
    problem = why;
  }

  void copyPlain(char*& out, std::size_t& out_size) {
    const std::size_t n = std::min(in_size, out_size);
    std::memcpy(out, in, n);
    in += n, in_size -= n, out += n, out_size -= n;
  }

  // Called between two members.
  void startMember() {
    if (decoder->beginsWith(*in)) {
      decoder->startMember();
      in_member = true;
    } else if (*in == '\0') {
      ++in, --in_size;
    } else {
      end(Ending::corrupt, "other bytes follow the compressed data");
    }
  }

  void decode(char*& out, std::size_t& out_size) {
    switch (decoder->decode(in, in_size, out, out_size)) {
      case Decoder::Step::more:
        break;
      case Decoder::Step::member_end:
        in_member = false;
        break;
      case Decoder::Step::bad:
        end(Ending::corrupt, decoder->problem());
        break;
    }
  }
};

CompressedFile::CompressedFile(const std::string& path) : state_(std::make_unique<State>()) {
  auto& s = *state_;
  s.path = path;
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0) refuse(path, std::string(std::strerror(errno)) + "; is the path right?");
  if (S_ISDIR(status.st_mode)) refuse(path, describeInput(path));
  if (!S_ISREG(status.st_mode))
    refuse(path, "is a pipe, a socket or a device, which cannot be read as a log; save its data in a file.");
  s.size = static_cast<std::uint64_t>(status.st_size);
  s.file = std::fopen(path.c_str(), "rb");
  if (!s.file) refuse(path, std::string(std::strerror(errno)) + "; may you read this file?");
  if (!s.refill()) refuse(path, s.ending == Ending::end ? "is empty; copy or record it again." : s.problem + ".");
  if (s.in_size >= 2 && s.in[0] == '\x1f' && s.in[1] == '\x8b') s.decoder = std::make_unique<GzipDecoder>();
  if (s.in_size >= 3 && std::memcmp(s.in, "BZh", 3) == 0) s.decoder = std::make_unique<Bzip2Decoder>();
}

CompressedFile::~CompressedFile() = default;

std::size_t CompressedFile::read(void* buffer, std::size_t size) {
  auto& s = *state_;
  char* out = static_cast<char*>(buffer);
  // The decoders count in 32 bits, so large reads are split.
  std::size_t left = size;
  while (left > 0 && s.ending == Ending::open) {
    if (!s.refill()) break;
    if (!s.decoder) {
      s.copyPlain(out, left);
    } else if (!s.in_member) {
      s.startMember();
    } else {
      std::size_t window = std::min<std::size_t>(left, 1u << 30);
      const std::size_t asked = window;
      s.decode(out, window);
      left -= asked - window;
    }
  }
  s.position += size - left;
  return size - left;
}

CompressedFile::Ending CompressedFile::ending() const {
  return state_->ending;
}
const std::string& CompressedFile::problem() const {
  return state_->problem;
}
bool CompressedFile::isCompressed() const {
  return state_->decoder != nullptr;
}
std::uint64_t CompressedFile::position() const {
  return state_->position;
}
const std::string& CompressedFile::path() const {
  return state_->path;
}

double CompressedFile::fraction() const {
  if (state_->ending != Ending::open || state_->size == 0) return 1.0;
  const double used = static_cast<double>(state_->disk_bytes - state_->in_size);
  return std::min(1.0, used / static_cast<double>(state_->size));
}

}  // namespace omnimapper::source
