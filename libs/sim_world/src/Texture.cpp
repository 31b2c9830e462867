#include <omnimapper/sim_world/Texture.h>

#include <cmath>

namespace omnimapper::sim {

Eigen::Vector3f Texture::at(float u, float v) const {
  const float x = (u - std::floor(u)) * width - 0.5f, y = (1.0f - (v - std::floor(v))) * height - 0.5f;
  const float left = std::floor(x), top = std::floor(y), right_share = x - left, bottom_share = y - top;
  const auto wrapped = [](int i, int size) { return i < 0 ? i + size : i >= size ? i - size : i; };
  const int x0 = wrapped(static_cast<int>(left), width), x1 = wrapped(static_cast<int>(left) + 1, width);
  const int y0 = wrapped(static_cast<int>(top), height), y1 = wrapped(static_cast<int>(top) + 1, height);
  const auto pixel = [&](int column, int row) {
    const std::uint8_t* p = &rgb[3 * (static_cast<std::size_t>(row) * width + column)];
    return Eigen::Vector3f(p[0], p[1], p[2]);
  };
  const Eigen::Vector3f above = (1 - right_share) * pixel(x0, y0) + right_share * pixel(x1, y0);
  const Eigen::Vector3f below = (1 - right_share) * pixel(x0, y1) + right_share * pixel(x1, y1);
  return ((1 - bottom_share) * above + bottom_share * below) / 255.0f;
}

}  // namespace omnimapper::sim
