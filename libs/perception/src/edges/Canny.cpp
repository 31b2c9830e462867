#include "Canny.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <opencv2/imgproc.hpp>

namespace omnimapper::perception::edges {

namespace {

// Converts a row of colours to grey with the weights of ITU-R BT.601, in parts of 256.
template <int kFirst, int kThird>
void writeGrey(const std::uint8_t* from, int n, std::uint8_t* to) {
  for (int x = 0; x < n; ++x, from += 3) {
    to[x] = static_cast<std::uint8_t>((kFirst * from[0] + 150 * from[1] + kThird * from[2] + 128) >> 8);
  }
}

cv::Mat greyOf(const camera::ColourImage& image) {
  cv::Mat grey(image.height, image.width, CV_8UC1);
  for (int y = 0; y < image.height; ++y) {
    const std::uint8_t* from = image.pixels + static_cast<std::ptrdiff_t>(y) * image.stride;
    switch (image.order) {
      case camera::ColourImage::Order::grey:
        std::copy(from, from + image.width, grey.ptr(y));
        break;
      case camera::ColourImage::Order::rgb:
        writeGrey<77, 29>(from, image.width, grey.ptr(y));
        break;
      case camera::ColourImage::Order::bgr:
        writeGrey<29, 77>(from, image.width, grey.ptr(y));
        break;
    }
  }
  return grey;
}

}  // namespace

Candidates canny(const camera::ColourImage& image, int low, int high) {
  Candidates candidates(image.width, image.height);
  if (image.width == 0 || image.height == 0) return candidates;
  cv::Mat edges;
  cv::Canny(greyOf(image), edges, low, high);
  for (int y = 0; y < image.height; ++y) {
    const std::uint8_t* from = edges.ptr(y);
    std::transform(from, from + image.width, candidates.row(y), [](std::uint8_t edge) {
      return static_cast<std::uint8_t>(edge != 0 ? Candidates::kKept : Candidates::kNothing);
    });
  }
  return candidates;
}

}  // namespace omnimapper::perception::edges
