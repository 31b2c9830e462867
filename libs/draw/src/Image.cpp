#include <omnimapper/base/Error.h>
#include <omnimapper/draw/Image.h>
#include <zlib.h>

#include <cstddef>
#include <string>
#include <string_view>

namespace omnimapper::draw {

namespace {

/// The pixel format in a PNG header, and the compression level of zlib.
struct Layout {
  int width, height;
  std::uint8_t bits, colour_type;
  int compression;
};

// Compression levels, fast rather than small: pictures of maps are flat areas, and those of sensors are many.
constexpr int kOfMaps = 3, kOfSensors = Z_BEST_SPEED;
constexpr std::uint8_t kGrey = 0, kTrueColour = 2, kPalette = 3;

void appendBigEndian(std::string& out, std::uint32_t value) {
  for (int shift = 24; shift >= 0; shift -= 8) out.push_back(static_cast<char>(value >> shift));
}

void appendChunk(std::string& out, std::string_view type, std::string_view data) {
  appendBigEndian(out, static_cast<std::uint32_t>(data.size()));
  const std::size_t start = out.size();
  out.append(type);
  out.append(data);
  appendBigEndian(out, static_cast<std::uint32_t>(crc32(0, reinterpret_cast<const Bytef*>(out.data() + start),
                                                        static_cast<uInt>(out.size() - start))));
}

// Each row is preceded by the number of its filter: 0, none.
std::string withFilterBytes(const char* pixels, std::size_t row_bytes, int rows) {
  std::string result;
  result.reserve((row_bytes + 1) * static_cast<std::size_t>(rows));
  for (int row = 0; row < rows; ++row) {
    result.push_back(0);
    result.append(pixels + static_cast<std::size_t>(row) * row_bytes, row_bytes);
  }
  return result;
}

// Each row as differences to the row above (filter 2), which zlib packs better and faster than depths themselves.
std::string filteredUp(const Grey16Image& image) {
  const auto width = static_cast<std::size_t>(image.width), height = static_cast<std::size_t>(image.height);
  std::string rows(height * (1 + 2 * width), '\2');
  std::size_t next = 0;
  for (std::size_t row = 0; row < height; ++row) {
    ++next;  // the filter's number
    const std::uint16_t* line = &image.pixels[row * width];
    for (std::size_t column = 0; column < width; ++column) {
      const int value = line[column], above = row > 0 ? image.pixels[(row - 1) * width + column] : 0;
      rows[next++] = static_cast<char>((value >> 8) - (above >> 8));
      rows[next++] = static_cast<char>((value & 0xFF) - (above & 0xFF));
    }
  }
  return rows;
}

std::string deflated(const std::string& bytes, int compression) {
  uLongf size = compressBound(bytes.size());
  std::string result(size, '\0');
  const int status = compress2(reinterpret_cast<Bytef*>(result.data()), &size,
                               reinterpret_cast<const Bytef*>(bytes.data()), bytes.size(), compression);
  if (status != Z_OK) throw base::Error(base::ExitCode::internal, "a picture cannot be compressed: not enough memory");
  result.resize(size);
  return result;
}

std::string encode(const Layout& layout, std::string_view palette, const std::string& rows) {
  std::string out = "\x89PNG\r\n\x1a\n";
  std::string header;
  appendBigEndian(header, static_cast<std::uint32_t>(layout.width));
  appendBigEndian(header, static_cast<std::uint32_t>(layout.height));
  header.push_back(static_cast<char>(layout.bits));  // of a channel
  header.push_back(static_cast<char>(layout.colour_type));
  header.append(3, '\0');  // the only compression, the only filter method, not interlaced
  appendChunk(out, "IHDR", header);
  if (!palette.empty()) appendChunk(out, "PLTE", palette);
  appendChunk(out, "IDAT", deflated(rows, layout.compression));
  appendChunk(out, "IEND", {});
  return out;
}

}  // namespace

std::string encodePng(const Image& image) {
  static_assert(sizeof(Rgb) == 3);
  const auto rows = withFilterBytes(reinterpret_cast<const char*>(image.pixels.data()),
                                    3 * static_cast<std::size_t>(image.width), image.height);
  return encode({image.width, image.height, 8, kTrueColour, kOfMaps}, {}, rows);
}

std::string encodePng(const PaletteImage& image) {
  const std::string_view palette(reinterpret_cast<const char*>(image.palette.data()), 3 * image.palette.size());
  const auto rows = withFilterBytes(reinterpret_cast<const char*>(image.pixels.data()),
                                    static_cast<std::size_t>(image.width), image.height);
  return encode({image.width, image.height, 8, kPalette, kOfMaps}, palette, rows);
}

std::string encodePng(const Grey16Image& image) {
  const auto width = static_cast<std::size_t>(image.width), height = static_cast<std::size_t>(image.height);
  if (image.width < 1 || image.height < 1 || image.pixels.size() != width * height)
    throw base::Error(base::ExitCode::internal, "a picture of 16 bits needs width x height pixels, at least one");
  return encode({image.width, image.height, 16, kGrey, kOfSensors}, {}, filteredUp(image));
}

}  // namespace omnimapper::draw
