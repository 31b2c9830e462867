#include "Ply.h"

#include <cstdint>
#include <cstring>

namespace omnimapper::plugins {

namespace {

void appendFloat(std::string& out, float value) {
  std::uint32_t bits;
  std::memcpy(&bits, &value, sizeof bits);
  for (int shift = 0; shift < 32; shift += 8) out.push_back(static_cast<char>(bits >> shift));
}

}  // namespace

std::string encodePly(const std::vector<ColouredPoint>& points) {
  std::string out =
      "ply\nformat binary_little_endian 1.0\ncomment OmniMapper: points in the map frame, metres\nelement vertex " +
      std::to_string(points.size()) +
      "\nproperty float x\nproperty float y\nproperty float z\n"
      "property uchar red\nproperty uchar green\nproperty uchar blue\nend_header\n";
  out.reserve(out.size() + 15 * points.size());
  for (const ColouredPoint& point : points) {
    for (const float coordinate : {point.in_map.x, point.in_map.y, point.in_map.z}) appendFloat(out, coordinate);
    for (const std::uint8_t channel : {point.colour.r, point.colour.g, point.colour.b}) {
      out.push_back(static_cast<char>(channel));
    }
  }
  return out;
}

}  // namespace omnimapper::plugins
