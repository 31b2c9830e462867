#include "decompressed.h"

#include <bzlib.h>
#include <lz4frame.h>
#include <zstd.h>

#include <algorithm>
#include <memory>

namespace omnimapper::ros {

namespace {

constexpr const char* kTooLarge = "is larger than it states";
constexpr const char* kCut = "ends too early";

// Makes room behind the bytes that are there already; returns how much. None is left at the limit.
std::size_t roomIn(std::string& bytes, std::size_t used, std::size_t most) {
  constexpr std::size_t kFirst = std::size_t{1} << 16;
  if (used == bytes.size()) bytes.resize(std::min(most, std::max(kFirst, 2 * used)));
  return bytes.size() - used;
}

Decompressed fromBzip2(std::string_view in, std::size_t most) {
  Decompressed out;
  bz_stream stream{};
  if (BZ2_bzDecompressInit(&stream, 0, 0) != BZ_OK) return {"", "cannot be decompressed"};
  stream.next_in = const_cast<char*>(in.data());
  stream.avail_in = static_cast<unsigned>(in.size());
  std::size_t used = 0;
  int result = BZ_OK;
  while (result == BZ_OK) {
    // At the limit one more byte is asked for, which tells whether the data end there.
    const std::size_t room = roomIn(out.bytes, used, most), asked = std::max<std::size_t>(room, 1);
    char beyond = 0;
    stream.next_out = room > 0 ? out.bytes.data() + used : &beyond;
    stream.avail_out = static_cast<unsigned>(asked);
    result = BZ2_bzDecompress(&stream);
    const std::size_t got = asked - stream.avail_out;
    if (room == 0 && got > 0) out.problem = kTooLarge;
    if (result == BZ_OK && got == 0 && stream.avail_in == 0) out.problem = kCut;
    if (!out.problem.empty()) break;
    used += got;
  }
  BZ2_bzDecompressEnd(&stream);
  out.bytes.resize(used);
  if (out.problem.empty() && result != BZ_STREAM_END) out.problem = "is damaged (bzip2)";
  return out;
}

Decompressed fromLz4(std::string_view in, std::size_t most) {
  Decompressed out;
  LZ4F_dctx* made = nullptr;
  if (LZ4F_isError(LZ4F_createDecompressionContext(&made, LZ4F_VERSION))) return {"", "cannot be decompressed"};
  const std::unique_ptr<LZ4F_dctx, LZ4F_errorCode_t (*)(LZ4F_dctx*)> context(made, LZ4F_freeDecompressionContext);
  std::size_t used = 0, taken = 0;
  for (std::size_t hint = 1; hint != 0;) {
    std::size_t room = roomIn(out.bytes, used, most), read = in.size() - taken;
    const std::size_t had_room = room;
    hint = LZ4F_decompress(context.get(), out.bytes.data() + used, &room, in.data() + taken, &read, nullptr);
    if (LZ4F_isError(hint)) {
      out.problem = std::string("is damaged (LZ4: ") + LZ4F_getErrorName(hint) + ")";
      break;
    }
    used += room;
    taken += read;
    if (hint != 0 && room == 0 && read == 0) {
      out.problem = had_room == 0 ? kTooLarge : kCut;
      break;
    }
  }
  out.bytes.resize(used);
  return out;
}

Decompressed fromZstd(std::string_view in, std::size_t most) {
  Decompressed out;
  const std::unique_ptr<ZSTD_DStream, size_t (*)(ZSTD_DStream*)> stream(ZSTD_createDStream(), ZSTD_freeDStream);
  constexpr int kLargestWindow = 27;  // log2 of bytes; the window of a frame is allocated before it is read
  ZSTD_DCtx_setParameter(stream.get(), ZSTD_d_windowLogMax, kLargestWindow);
  ZSTD_inBuffer from{in.data(), in.size(), 0};
  std::size_t used = 0;
  for (std::size_t hint = 1; hint != 0 || from.pos < from.size;) {
    const std::size_t room = roomIn(out.bytes, used, most), before = from.pos;
    ZSTD_outBuffer to{out.bytes.data() + used, room, 0};
    hint = ZSTD_decompressStream(stream.get(), &to, &from);
    if (ZSTD_isError(hint)) {
      out.problem = std::string("is damaged (Zstandard: ") + ZSTD_getErrorName(hint) + ")";
      break;
    }
    used += to.pos;
    if (to.pos == 0 && from.pos == before) {
      if (hint != 0) out.problem = room == 0 ? kTooLarge : kCut;
      break;
    }
  }
  out.bytes.resize(used);
  return out;
}

}  // namespace

bool isKnownCompression(std::string_view name) {
  return name.empty() || name == "none" || name == "bz2" || name == "lz4" || name == "zstd";
}

Decompressed decompressed(std::string_view compression, std::string_view bytes, std::size_t most) {
  if (compression == "bz2") return fromBzip2(bytes, most);
  if (compression == "lz4") return fromLz4(bytes, most);
  if (compression == "zstd") return fromZstd(bytes, most);
  if (bytes.size() > most) return {std::string(bytes.substr(0, most)), kTooLarge};
  return {std::string(bytes), ""};
}

bool isZstd(std::string_view bytes) {
  return bytes.substr(0, 4) == "\x28\xb5\x2f\xfd";
}

}  // namespace omnimapper::ros
