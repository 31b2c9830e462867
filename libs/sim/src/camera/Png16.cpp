#include "Png16.h"

#include <zlib.h>

#include <stdexcept>

namespace omnimapper::sim {

namespace {

void appendBig(std::string& bytes, std::uint32_t value) {
  for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(value >> shift & 0xFF);
}

void appendChunk(std::string& file, const std::string& type, const std::string& data) {
  appendBig(file, static_cast<std::uint32_t>(data.size()));
  const std::string covered = type + data;
  file += covered;
  appendBig(file, static_cast<std::uint32_t>(
                      crc32(0, reinterpret_cast<const Bytef*>(covered.data()), static_cast<uInt>(covered.size()))));
}

// Each row as differences to the row above (filter 2), which zlib packs better and faster than the values.
std::string filtered(const std::vector<std::uint16_t>& values, int width, int height) {
  std::string rows(static_cast<std::size_t>(height) * (1 + 2 * width), '\2');
  std::size_t next = 0;
  for (int row = 0; row < height; ++row) {
    ++next;  // the filter's number
    const std::uint16_t* line = &values[static_cast<std::size_t>(row) * width];
    for (int column = 0; column < width; ++column) {
      const int value = line[column], above = row > 0 ? line[column - width] : 0;
      rows[next++] = static_cast<char>((value >> 8) - (above >> 8));
      rows[next++] = static_cast<char>((value & 0xFF) - (above & 0xFF));
    }
  }
  return rows;
}

}  // namespace

std::string png16(const std::vector<std::uint16_t>& values, int width, int height) {
  if (width < 1 || height < 1 || values.size() != static_cast<std::size_t>(width) * height)
    throw std::invalid_argument("png16: values are not those of a picture of this size");
  std::string file = "\x89PNG\r\n\x1a\n", header;
  appendBig(header, static_cast<std::uint32_t>(width));
  appendBig(header, static_cast<std::uint32_t>(height));
  header += std::string{16, 0, 0, 0, 0};  // bits, grey, deflate, adaptive filters, not interlaced
  appendChunk(file, "IHDR", header);
  const std::string rows = filtered(values, width, height);
  std::string packed(compressBound(static_cast<uLong>(rows.size())), '\0');
  auto size = static_cast<uLongf>(packed.size());
  if (compress2(reinterpret_cast<Bytef*>(packed.data()), &size, reinterpret_cast<const Bytef*>(rows.data()),
                static_cast<uLong>(rows.size()), Z_BEST_SPEED) != Z_OK)
    throw std::runtime_error("png16: zlib has no memory");
  packed.resize(size);
  appendChunk(file, "IDAT", packed);
  appendChunk(file, "IEND", "");
  return file;
}

}  // namespace omnimapper::sim
