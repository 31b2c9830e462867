#include "ImageSize.h"

#include <cstdint>
#include <fstream>

namespace omnimapper::source {

namespace {

struct Size {
  std::uint64_t width = 0, height = 0;
};

// Of numbers whose most significant byte comes first.
std::uint64_t numberAt(const std::string& bytes, std::size_t at, std::size_t size) {
  std::uint64_t number = 0;
  for (std::size_t i = 0; i < size; ++i) number = number << 8 | static_cast<unsigned char>(bytes[at + i]);
  return number;
}

// The first chunk of a PNG is its header: width and height, four bytes each.
std::optional<Size> sizeOfPng(const std::string& head) {
  constexpr std::size_t kWidthAt = 16, kHeightAt = 20;
  if (head.size() < kHeightAt + 4 || head.compare(0, 8, "\x89PNG\r\n\x1a\n") != 0) return std::nullopt;
  return Size{numberAt(head, kWidthAt, 4), numberAt(head, kHeightAt, 4)};
}

std::string read(std::ifstream& in, std::size_t size) {
  std::string bytes(size, '\0');
  in.read(bytes.data(), static_cast<std::streamsize>(size));
  bytes.resize(static_cast<std::size_t>(in.gcount()));
  return bytes;
}

// A JPEG is segments: 0xff, a marker, two bytes of length. Those of the markers 0xc0 to 0xcf but 0xc4, 0xc8 and 0xcc
// begin a frame and have a byte of precision, then height and width, two bytes each.
std::optional<Size> sizeOfJpeg(std::ifstream& in) {
  in.clear();  // the file may end within what was read of it
  in.seekg(2);
  while (true) {
    const auto start = read(in, 4);
    if (start.size() < 4 || start[0] != '\xff') return std::nullopt;
    const auto marker = static_cast<unsigned char>(start[1]);
    if (marker == 0xff) {  // a fill byte
      in.seekg(-3, std::ios::cur);
      continue;
    }
    const bool begins_frame = marker >= 0xc0 && marker <= 0xcf && marker != 0xc4 && marker != 0xc8 && marker != 0xcc;
    const std::uint64_t length = numberAt(start, 2, 2);
    if (length < 2) return std::nullopt;
    if (begins_frame) {
      const auto frame = read(in, 5);
      if (frame.size() < 5) return std::nullopt;
      return Size{numberAt(frame, 3, 2), numberAt(frame, 1, 2)};
    }
    in.seekg(static_cast<std::streamoff>(length) - 2, std::ios::cur);
  }
}

}  // namespace

std::optional<std::string> whyTooLarge(const std::string& path) {
  constexpr std::uint64_t kMostPixels = 1 << 26;  // 8192 x 8192
  std::ifstream in(path, std::ios::binary);
  const auto head = read(in, 24);
  const bool is_jpeg = head.compare(0, 2, "\xff\xd8") == 0;
  const auto size = is_jpeg ? sizeOfJpeg(in) : sizeOfPng(head);
  if (!size || size->width == 0 || size->height <= kMostPixels / size->width) return std::nullopt;
  return std::to_string(size->width) + " x " + std::to_string(size->height) + " pixels, more than any camera has";
}

}  // namespace omnimapper::source
