#include "GridImage.h"

#include <omnimapper/base/Error.h>
#include <omnimapper/base/InputFile.h>

#include <cctype>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

namespace omnimapper::grid {

namespace {

constexpr std::int64_t kMostCells = 400'000'000;

[[noreturn]] void refuseImage(const std::string& file, const std::string& reason) {
  throw base::Error(base::ExitCode::unreadable_input, file + ": " + reason);
}

void expectSize(const std::string& file, std::int64_t columns, std::int64_t rows) {
  if (columns > kMostCells / rows)
    refuseImage(file, "has a header of " + std::to_string(columns) + " x " + std::to_string(rows) +
                          " cells, more than " + std::to_string(kMostCells) + ".");
}

/// The next number of a PGM's header after blanks and comments; negative if there is none. Moves `at` behind the
/// character that ends the number.
std::int64_t headerNumber(const std::string& bytes, std::size_t& at) {
  constexpr std::int64_t kLargest = 1'000'000'000;
  const auto isBlank = [](char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; };
  while (at < bytes.size() && (isBlank(bytes[at]) || bytes[at] == '#'))
    at = bytes[at] == '#' ? std::min(bytes.find('\n', at), bytes.size()) : at + 1;
  std::int64_t number = -1;
  for (; at < bytes.size() && std::isdigit(static_cast<unsigned char>(bytes[at])) != 0; ++at) {
    number = 10 * std::max<std::int64_t>(number, 0) + (bytes[at] - '0');
    if (number > kLargest) return -1;
  }
  ++at;
  return number;
}

GridImage readPgm(const std::string& file, const std::string& bytes) {
  std::size_t at = 2;
  const std::int64_t columns = headerNumber(bytes, at), rows = headerNumber(bytes, at), white = headerNumber(bytes, at);
  if (columns <= 0 || rows <= 0 || white <= 0 || white > 255)
    refuseImage(file, "has no header of an 8-bit PGM: width, height and the value of white must follow \"P5\".");
  expectSize(file, columns, rows);
  const auto left = static_cast<std::int64_t>(bytes.size()) - static_cast<std::int64_t>(at);
  if (left < columns * rows)
    refuseImage(file, "is truncated: its header gives " + std::to_string(columns) + " x " + std::to_string(rows) +
                          " cells, but only " + std::to_string(std::max<std::int64_t>(left, 0)) + " bytes follow.");
  GridImage image{static_cast<int>(columns), static_cast<int>(rows), static_cast<int>(white), {}, {}};
  const auto begin = bytes.begin() + static_cast<std::ptrdiff_t>(at);
  image.levels.assign(begin, begin + columns * rows);
  return image;
}

/// The size in the header of a PNG, so that a picture that is too large is not decoded.
void expectPngSize(const std::string& file, const std::string& bytes) {
  constexpr std::size_t kWidthAt = 16, kHeaderSize = 24;
  if (bytes.size() < kHeaderSize) refuseImage(file, "is truncated.");
  const auto number = [&](std::size_t at) {
    std::int64_t value = 0;
    for (std::size_t i = 0; i < 4; ++i) value = value << 8 | static_cast<unsigned char>(bytes[at + i]);
    return value;
  };
  const std::int64_t columns = number(kWidthAt), rows = number(kWidthAt + 4);
  if (columns <= 0 || rows <= 0) refuseImage(file, "has no pixels.");
  expectSize(file, columns, rows);
}

GridImage readPng(const std::string& file, const std::string& bytes) {
  expectPngSize(file, bytes);
  const cv::Mat raw(1, static_cast<int>(bytes.size()), CV_8U, const_cast<char*>(bytes.data()));
  cv::Mat pixels;
  try {
    pixels = cv::imdecode(raw, cv::IMREAD_UNCHANGED);
  } catch (const cv::Exception&) {
    refuseImage(file, "is a PNG that cannot be decoded.");
  }
  if (pixels.empty() || pixels.depth() != CV_8U) refuseImage(file, "is not a PNG of 8 bits a channel.");
  GridImage image{pixels.cols, pixels.rows, 255, {}, {}};
  const int channels = pixels.channels();
  const bool has_opacity = channels == 2 || channels == 4;
  image.levels.reserve(pixels.total());
  for (int row = 0; row < pixels.rows; ++row) {
    const std::uint8_t* pixel = pixels.ptr(row);
    for (int column = 0; column < pixels.cols; ++column, pixel += channels) {
      int sum = 0;
      for (int i = 0; i < channels; ++i) sum += pixel[i];
      image.levels.push_back(static_cast<std::uint8_t>(sum / channels));
      if (has_opacity) image.opaque.push_back(pixel[channels - 1] == 255 ? 1 : 0);
    }
  }
  return image;
}

}  // namespace

GridImage readGridImage(const std::string& file) {
  const std::string bytes = base::readInput(file, "occupancy grid");
  if (bytes.compare(0, 2, "P5") == 0) return readPgm(file, bytes);
  if (bytes.compare(0, 4, "\x89PNG") == 0) return readPng(file, bytes);
  refuseImage(file, "is not a binary PGM (it does not begin with \"P5\") and not a PNG.");
}

}  // namespace omnimapper::grid
