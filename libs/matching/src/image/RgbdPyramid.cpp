#include <omnimapper/base/Error.h>
#include <omnimapper/matching/RgbdPyramid.h>

#include <algorithm>
#include <iterator>
#include <string>

namespace omnimapper::matching {

namespace {

using camera::ColourImage;
using camera::DepthImage;

constexpr int kSmallest = 20;  // [px] columns and rows of the coarsest level
// Largest relative difference of two inverse depths of one surface: that of neighbouring pixels at half a metre on a
// wall seen at 80 deg.
constexpr float kDiscontinuity = 0.05F;

// 1 / z, or 0 if the depth is not valid. The division without a branch lets loops compute several pixels at once.
float inverseIf(bool is_valid, float z) {
  return (is_valid ? 1.F : 0.F) / (is_valid ? z : 1.F);
}

std::vector<float> inverseDepths(const DepthImage& image, const RgbdPyramidOptions& options) {
  const auto size = static_cast<std::size_t>(image.width()) * static_cast<std::size_t>(image.height());
  std::vector<float> inverse(size);
  const auto low = static_cast<float>(options.min_depth), high = static_cast<float>(options.max_depth);
  if (image.units() != nullptr) {
    constexpr std::uint16_t kSaturated = 65535;
    const auto unit = static_cast<float>(image.metresPerUnit());
    for (std::size_t i = 0; i < size; ++i) {
      const float z = unit * static_cast<float>(image.units()[i]);
      inverse[i] = inverseIf(z >= low && z <= high && image.units()[i] != kSaturated, z);
    }
  } else {
    for (std::size_t i = 0; i < size; ++i) {
      const float z = image.metres()[i];
      inverse[i] = inverseIf(z >= low && z <= high, z);
    }
  }
  return inverse;
}

std::vector<float> greys(const ColourImage& picture) {
  std::vector<float> grey(static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height));
  float* to = grey.data();
  const bool is_red_first = picture.order == ColourImage::Order::rgb;
  for (int y = 0; y < picture.height; ++y) {
    const std::uint8_t* row = picture.pixels + static_cast<std::ptrdiff_t>(y) * picture.stride;
    if (picture.order == ColourImage::Order::grey) {
      for (int x = 0; x < picture.width; ++x) *to++ = row[x];
      continue;
    }
    // Weights of ITU-R BT.601 in 256ths.
    const int first = is_red_first ? 77 : 29, third = is_red_first ? 29 : 77;
    for (int x = 0; x < picture.width; ++x, row += 3)
      *to++ = static_cast<float>(first * row[0] + 150 * row[1] + third * row[2]) * (1.0F / 256);
  }
  return grey;
}

// The mean inverse depth of the surface nearest to the camera; 0 if fewer than three pixels lie on it, because
// their centre would differ from that of the four.
float nearestMean(float a, float b, float c, float d) {
  const float nearest = std::max(std::max(a, b), std::max(c, d));
  const float least = nearest * (1 - kDiscontinuity);
  // Without branches, so that loops compute several pixels at once.
  const auto isOfIt = [least](float one) { return one >= least && one > 0 ? 1.F : 0.F; };
  const float of_a = isOfIt(a), of_b = isOfIt(b), of_c = isOfIt(c), of_d = isOfIt(d);
  const float sum = a * of_a + b * of_b + c * of_c + d * of_d, count = of_a + of_b + of_c + of_d;
  return (count >= 3 ? sum : 0) / (count >= 3 ? count : 1);
}

RgbdLevel halved(const RgbdLevel& fine) {
  RgbdLevel coarse;
  coarse.width = fine.width / 2;
  coarse.height = fine.height / 2;
  // The middle of the first coarse pixel is at (0.5, 0.5) of the fine ones.
  coarse.camera = {0.5 * fine.camera.fx, 0.5 * fine.camera.fy, 0.5 * (fine.camera.cx - 0.5),
                   0.5 * (fine.camera.cy - 0.5)};
  const auto size = static_cast<std::size_t>(coarse.width) * static_cast<std::size_t>(coarse.height);
  coarse.inverse_depth.resize(size);
  coarse.grey.resize(fine.grey.empty() ? 0 : size);
  for (int y = 0; y < coarse.height; ++y) {
    const std::size_t upper = fine.at(0, 2 * y), lower = fine.at(0, 2 * y + 1), to = coarse.at(0, y);
    const auto width = static_cast<std::size_t>(coarse.width);
    const float *a = fine.inverse_depth.data() + upper, *b = fine.inverse_depth.data() + lower;
    for (std::size_t x = 0; x < width; ++x)
      coarse.inverse_depth[to + x] = nearestMean(a[2 * x], a[2 * x + 1], b[2 * x], b[2 * x + 1]);
    if (fine.grey.empty()) continue;
    const float *g = fine.grey.data() + upper, *h = fine.grey.data() + lower;
    for (std::size_t x = 0; x < width; ++x)
      coarse.grey[to + x] = 0.25F * (g[2 * x] + g[2 * x + 1] + h[2 * x] + h[2 * x + 1]);
  }
  return coarse;
}

}  // namespace

RgbdPyramid::RgbdPyramid(const DepthImage& depth, const ColourImage* colour, const RgbdPyramidOptions& options) {
  if (colour != nullptr && (colour->width != depth.width() || colour->height != depth.height())) {
    throw base::Error(base::ExitCode::unreadable_input,
                      "a picture of " + std::to_string(colour->width) + " x " + std::to_string(colour->height) +
                          " pixels does not match a depth image of " + std::to_string(depth.width()) + " x " +
                          std::to_string(depth.height()));
  }
  RgbdLevel finest;
  finest.width = depth.width();
  finest.height = depth.height();
  finest.camera = depth.camera();
  finest.inverse_depth = inverseDepths(depth, options);
  if (colour != nullptr) finest.grey = greys(*colour);
  levels_.push_back(std::move(finest));
  while (static_cast<int>(levels_.size()) < options.levels &&
         std::min(levels_.back().width, levels_.back().height) >= 2 * kSmallest)
    levels_.push_back(halved(levels_.back()));
}

std::optional<double> RgbdPyramid::medianDepth() const {
  constexpr double kLeast = 0.1;  // share of the pixels
  const auto& all = levels_.back().inverse_depth;
  std::vector<float> inverse;
  std::copy_if(all.begin(), all.end(), std::back_inserter(inverse), [](float one) { return one > 0; });
  if (static_cast<double>(inverse.size()) <= kLeast * static_cast<double>(all.size())) return std::nullopt;
  const auto middle = inverse.begin() + static_cast<std::ptrdiff_t>(inverse.size() / 2);
  std::nth_element(inverse.begin(), middle, inverse.end());
  return 1 / static_cast<double>(*middle);
}

}  // namespace omnimapper::matching
