#include "TexturePyramid.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "Srgb.h"

namespace omnimapper::sim {

namespace {

const std::array<std::uint16_t, 256>& linearTable() {
  static const std::array<std::uint16_t, 256> table = [] {
    std::array<std::uint16_t, 256> made{};
    for (int i = 0; i < 256; ++i) made[i] = static_cast<std::uint16_t>(std::lround(65535 * linearFromSrgb(i / 255.0)));
    return made;
  }();
  return table;
}

// Replaces std::floor, which is a function call on the oldest processors of this architecture.
int floorOf(float value) {
  const int cut = static_cast<int>(value);
  return cut - (value < static_cast<float>(cut));
}

}  // namespace

TexturePyramid::TexturePyramid(const Texture& texture) {
  Level first{texture.width, texture.height, std::vector<std::uint16_t>(texture.rgb.size())};
  for (std::size_t i = 0; i < texture.rgb.size(); ++i) first.rgb[i] = linearTable()[texture.rgb[i]];
  levels_.push_back(std::move(first));
  while (levels_.back().width > 1 || levels_.back().height > 1) levels_.push_back(halved(levels_.back()));
}

TexturePyramid::Level TexturePyramid::halved(const Level& level) {
  Level half{std::max(1, level.width / 2), std::max(1, level.height / 2), {}};
  half.rgb.resize(static_cast<std::size_t>(half.width) * half.height * 3);
  const int step_x = level.width > 1 ? 1 : 0, step_y = level.height > 1 ? 1 : 0;
  for (int y = 0; y < half.height; ++y) {
    for (int x = 0; x < half.width; ++x) {
      for (int c = 0; c < 3; ++c) {
        const auto texel = [&](int column, int row) {
          return level.rgb[3 * (static_cast<std::size_t>(row) * level.width + column) + c];
        };
        const int left = 2 * x * step_x, top = 2 * y * step_y;
        const unsigned sum = texel(left, top) + texel(left + step_x, top) + texel(left, top + step_y) +
                             texel(left + step_x, top + step_y);
        half.rgb[3 * (static_cast<std::size_t>(y) * half.width + x) + c] = static_cast<std::uint16_t>((sum + 2) / 4);
      }
    }
  }
  return half;
}

Eigen::Vector3f TexturePyramid::Level::at(float u, float v) const {
  const float x = (u - floorOf(u)) * width - 0.5f, y = (1.0f - (v - floorOf(v))) * height - 0.5f;
  const int left = floorOf(x), top = floorOf(y);
  const float right_share = x - left, bottom_share = y - top;
  const auto wrapped = [](int i, int size) { return i < 0 ? i + size : i >= size ? i - size : i; };
  const int x0 = wrapped(left, width), x1 = wrapped(left + 1, width);
  const int y0 = wrapped(top, height), y1 = wrapped(top + 1, height);
  const auto texel = [&](int column, int row) {
    const std::uint16_t* p = &rgb[3 * (static_cast<std::size_t>(row) * width + column)];
    return Eigen::Vector3f(p[0], p[1], p[2]);
  };
  const Eigen::Vector3f above = (1 - right_share) * texel(x0, y0) + right_share * texel(x1, y0);
  const Eigen::Vector3f below = (1 - right_share) * texel(x0, y1) + right_share * texel(x1, y1);
  return ((1 - bottom_share) * above + bottom_share * below) / 65535.0f;
}

Eigen::Vector3f TexturePyramid::at(const Eigen::Vector2f& uv, float footprint) const {
  const float level = footprint > 1 ? std::log2(footprint) : 0.0f;
  const auto finer = std::min(static_cast<std::size_t>(level), levels_.size() - 1);
  const float share = level - static_cast<float>(finer);
  const Eigen::Vector3f fine = levels_[finer].at(uv.x(), uv.y());
  if (share <= 0 || finer + 1 >= levels_.size()) return fine;
  return (1 - share) * fine + share * levels_[finer + 1].at(uv.x(), uv.y());
}

}  // namespace omnimapper::sim
