#include <omnimapper/derived/Ply.h>

#include <cstdint>
#include <cstring>

namespace omnimapper::derived {

namespace {

void appendUint(std::string& out, std::uint32_t value) {
  for (int shift = 0; shift < 32; shift += 8) out.push_back(static_cast<char>(value >> shift));
}

void appendFloat(std::string& out, float value) {
  std::uint32_t bits;
  std::memcpy(&bits, &value, sizeof bits);
  appendUint(out, bits);
}

void appendVertex(std::string& out, const mrpt::math::TPoint3Df& point, const draw::Rgb& colour) {
  for (const float coordinate : {point.x, point.y, point.z}) appendFloat(out, coordinate);
  for (const std::uint8_t channel : {colour.r, colour.g, colour.b}) out.push_back(static_cast<char>(channel));
}

std::string headerOf(const std::string& content, std::size_t vertices, const std::string& more) {
  return "ply\nformat binary_little_endian 1.0\ncomment OmniMapper: " + content +
         " in the map frame, metres\nelement vertex " + std::to_string(vertices) +
         "\nproperty float x\nproperty float y\nproperty float z\n"
         "property uchar red\nproperty uchar green\nproperty uchar blue\n" +
         more + "end_header\n";
}

}  // namespace

std::string encodePly(const std::vector<ColouredPoint>& points) {
  std::string out = headerOf("points", points.size(), "");
  out.reserve(out.size() + 15 * points.size());
  for (const ColouredPoint& point : points) appendVertex(out, point.in_map, point.colour);
  return out;
}

std::string encodePly(const std::vector<mrpt::opengl::TTriangle>& triangles) {
  std::string out =
      headerOf("landmarks", 3 * triangles.size(),
               "element face " + std::to_string(triangles.size()) + "\nproperty list uchar int vertex_indices\n");
  out.reserve(out.size() + (3 * 15 + 13) * triangles.size());
  for (const auto& triangle : triangles) {
    const draw::Rgb colour{triangle.r(0), triangle.g(0), triangle.b(0)};
    for (const auto& vertex : triangle.vertices) appendVertex(out, vertex.xyzrgba.pt, colour);
  }
  for (std::uint32_t i = 0; i < 3 * triangles.size(); ++i) {
    if (i % 3 == 0) out.push_back(3);
    appendUint(out, i);
  }
  return out;
}

}  // namespace omnimapper::derived
