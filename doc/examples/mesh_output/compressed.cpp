#include "compressed.h"

#include <omnimapper/base/Error.h>
#include <zlib.h>

namespace mesh_output {

Compressed compressed(const std::string& text) {
  constexpr int kWindowBits = 15 + 16;  // the largest window, in the format of gzip
  constexpr int kMemoryLevel = 8;       // zlib's default
  z_stream stream{};
  int state = deflateInit2(&stream, Z_DEFAULT_COMPRESSION, Z_DEFLATED, kWindowBits, kMemoryLevel, Z_DEFAULT_STRATEGY);
  std::string bytes;
  if (state == Z_OK) {
    bytes.resize(deflateBound(&stream, text.size()));
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(text.data()));
    stream.avail_in = static_cast<uInt>(text.size());
    stream.next_out = reinterpret_cast<Bytef*>(bytes.data());
    stream.avail_out = static_cast<uInt>(bytes.size());
    state = deflate(&stream, Z_FINISH);
    bytes.resize(stream.total_out);
    deflateEnd(&stream);
  }
  if (state != Z_STREAM_END) {
    throw omnimapper::base::Error(omnimapper::base::ExitCode::out_of_memory, "zlib cannot compress the mesh");
  }
  return {bytes, ".gz"};
}

}  // namespace mesh_output
