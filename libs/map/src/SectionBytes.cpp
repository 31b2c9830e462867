#include "SectionBytes.h"

#include <zlib.h>

namespace omnimapper::map {

namespace {

constexpr int kLevel = 1;  // the fastest level of zlib

}  // namespace

std::string compressed(const std::string& bytes) {
  uLongf size = compressBound(bytes.size());
  std::string packed(size, '\0');
  if (compress2(reinterpret_cast<Bytef*>(packed.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()),
                bytes.size(), kLevel) != Z_OK) {
    throw std::bad_alloc();
  }
  packed.resize(size);
  ByteWriter out;
  out.uint(bytes.size(), 8);
  out.block(packed);
  return out.take();
}

std::string readCompressed(ByteReader& in) {
  const std::uint64_t size = in.uint(8);
  const std::string_view packed = in.block();
  if (size == 0 || size > kMostPerByte * packed.size())
    throw base::Error(base::ExitCode::unreadable_input, "map file: a compressed block is damaged");
  std::string bytes(size, '\0');
  uLongf written = size;
  const int code = uncompress(reinterpret_cast<Bytef*>(bytes.data()), &written,
                              reinterpret_cast<const Bytef*>(packed.data()), packed.size());
  if (code != Z_OK || written != size)
    throw base::Error(base::ExitCode::unreadable_input, "map file: a compressed block is damaged");
  return bytes;
}

}  // namespace omnimapper::map
