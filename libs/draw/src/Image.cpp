#include <omnimapper/base/Error.h>
#include <omnimapper/draw/Image.h>
#include <zlib.h>

#include <string_view>

namespace omnimapper::draw {

namespace {

// Fast rather than small: pictures of maps are flat areas.
constexpr int kCompression = 3;
constexpr std::uint8_t kTrueColour = 2, kPalette = 3;

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

std::string deflated(const std::string& bytes) {
  uLongf size = compressBound(bytes.size());
  std::string result(size, '\0');
  const int status = compress2(reinterpret_cast<Bytef*>(result.data()), &size,
                               reinterpret_cast<const Bytef*>(bytes.data()), bytes.size(), kCompression);
  if (status != Z_OK) throw base::Error(base::ExitCode::internal, "a picture cannot be compressed: not enough memory");
  result.resize(size);
  return result;
}

std::string encode(int width, int height, std::uint8_t colour_type, std::string_view palette, const std::string& rows) {
  std::string out = "\x89PNG\r\n\x1a\n";
  std::string header;
  appendBigEndian(header, static_cast<std::uint32_t>(width));
  appendBigEndian(header, static_cast<std::uint32_t>(height));
  header.push_back(8);  // bits of a channel
  header.push_back(static_cast<char>(colour_type));
  header.append(3, '\0');  // the only compression, the only filter method, not interlaced
  appendChunk(out, "IHDR", header);
  if (!palette.empty()) appendChunk(out, "PLTE", palette);
  appendChunk(out, "IDAT", deflated(rows));
  appendChunk(out, "IEND", {});
  return out;
}

}  // namespace

std::string encodePng(const Image& image) {
  static_assert(sizeof(Rgb) == 3);
  const auto rows = withFilterBytes(reinterpret_cast<const char*>(image.pixels.data()),
                                    3 * static_cast<std::size_t>(image.width), image.height);
  return encode(image.width, image.height, kTrueColour, {}, rows);
}

std::string encodePng(const PaletteImage& image) {
  const std::string_view palette(reinterpret_cast<const char*>(image.palette.data()), 3 * image.palette.size());
  const auto rows = withFilterBytes(reinterpret_cast<const char*>(image.pixels.data()),
                                    static_cast<std::size_t>(image.width), image.height);
  return encode(image.width, image.height, kPalette, palette, rows);
}

}  // namespace omnimapper::draw
