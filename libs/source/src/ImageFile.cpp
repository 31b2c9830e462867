
#include <omnimapper/source/ImageFile.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>

namespace omnimapper::source {

namespace {

// Reads a number whose most significant byte comes first.
std::uint64_t numberAt(const std::string& bytes, std::size_t at, std::size_t size) {
  std::uint64_t number = 0;
  for (std::size_t i = 0; i < size; ++i) number = number << 8 | static_cast<unsigned char>(bytes[at + i]);
  return number;
}

std::string read(std::istream& in, std::size_t size) {
  std::string bytes(size, '\0');
  in.read(bytes.data(), static_cast<std::streamsize>(size));
  bytes.resize(static_cast<std::size_t>(in.gcount()));
  return bytes;
}

bool isJpeg(const std::string& head) {
  return head.compare(0, 2, "\xff\xd8") == 0;
}

// The first chunk of a PNG is its header: width and height, four bytes each.
std::optional<ImageSize> sizeOfPng(const std::string& head) {
  constexpr std::size_t kWidthAt = 16, kHeightAt = 20;
  if (head.size() < kHeightAt + 4 || head.compare(0, 8, "\x89PNG\r\n\x1a\n") != 0) return std::nullopt;
  return ImageSize{numberAt(head, kWidthAt, 4), numberAt(head, kHeightAt, 4)};
}

// After its first eight bytes a PNG consists of chunks: four bytes of length, four of name, the data, four of checksum.
// The last chunk is IEND.
bool hasPngEnd(std::istream& in) {
  in.clear();
  in.seekg(8);
  while (true) {
    const auto start = read(in, 8);
    if (start.size() < 8) return false;
    if (start.compare(4, 4, "IEND") == 0) return true;
    in.seekg(static_cast<std::streamoff>(numberAt(start, 0, 4)) + 4, std::ios::cur);
  }
}

struct Jpeg {
  ImageSize size;        // 0 x 0 if no frame is found
  bool is_whole = true;  // also if that cannot be determined
};

// A JPEG consists of segments: 0xff, a marker, two bytes of length. Those with the markers 0xc0 to 0xcf except 0xc4,
// 0xc8 and 0xcc begin a frame and have a byte of precision, then height and width, two bytes each. The pixels follow
// 0xda, and 0xff 0xd9, which does not occur in them, ends them.
Jpeg readJpeg(std::istream& in) {
  Jpeg jpeg;
  in.clear();  // the file may end within the bytes that were read as its head
  in.seekg(2);
  while (true) {
    const auto start = read(in, 4);
    if (start.size() < 4 || start[0] != '\xff') return jpeg;
    const auto marker = static_cast<unsigned char>(start[1]);
    if (marker == 0xff) {  // a fill byte
      in.seekg(-3, std::ios::cur);
      continue;
    }
    const bool begins_frame = marker >= 0xc0 && marker <= 0xcf && marker != 0xc4 && marker != 0xc8 && marker != 0xcc;
    const std::uint64_t length = numberAt(start, 2, 2);
    if (length < 2) return jpeg;
    const auto next = in.tellg() + static_cast<std::streamoff>(length) - std::streamoff{2};
    if (begins_frame) {
      const auto frame = read(in, 5);
      if (frame.size() == 5) jpeg.size = {numberAt(frame, 3, 2), numberAt(frame, 1, 2)};
    }
    in.seekg(next);
    if (marker == 0xda) {
      std::string pixels{std::istreambuf_iterator<char>(in), {}};
      jpeg.is_whole = pixels.find("\xff\xd9") != std::string::npos;
      return jpeg;
    }
  }
}

std::optional<ImageSize> sizeOfImage(std::istream& in) {
  const auto head = read(in, 24);
  const auto size = isJpeg(head) ? readJpeg(in).size : sizeOfPng(head).value_or(ImageSize());
  return size.width == 0 || size.height == 0 ? std::nullopt : std::optional(size);
}

std::optional<std::string> whyTooLargeSize(const std::optional<ImageSize>& size) {
  constexpr std::uint64_t kMostPixels = 1 << 26;  // 8192 x 8192
  if (!size || size->height <= kMostPixels / size->width) return std::nullopt;
  return "has " + std::to_string(size->width) + " x " + std::to_string(size->height) +
         " pixels, more than any camera has";
}

}  // namespace

std::optional<ImageSize> imageSizeIn(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return sizeOfImage(in);
}

bool isDeepGrey(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  const auto head = read(in, 26);  // after the size, a byte with the bits of a channel and one with the kind of pixels
  return sizeOfPng(head) && head.size() == 26 && head[24] == 16 && head[25] == 0;
}

bool holdsDeepGrey(const LogLook& look) {
  constexpr int kMostLooks = 1000;
  int looks = 0;
  return std::any_of(look.entries.begin(), look.entries.end(), [&](const std::string& entry) {
    const auto file = std::filesystem::path(look.path) / entry;
    return file.extension() == ".png" && ++looks <= kMostLooks && isDeepGrey(file.string());
  });
}

std::optional<std::string> whyTooLarge(const std::string& path) {
  return whyTooLargeSize(imageSizeIn(path));
}

std::optional<std::string> whyTooLargeImage(std::string_view bytes) {
  constexpr std::size_t kHead = std::size_t{1} << 18;  // [bytes] a JPEG has its preview before its size
  std::istringstream in{std::string(bytes.substr(0, kHead))};
  return whyTooLargeSize(sizeOfImage(in));
}

bool isCutOff(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  const auto head = read(in, 24);
  if (isJpeg(head)) return !readJpeg(in).is_whole;
  return sizeOfPng(head) && !hasPngEnd(in);
}

}  // namespace omnimapper::source
