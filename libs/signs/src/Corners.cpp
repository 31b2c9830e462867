#include "Corners.h"

namespace omnimapper::signs {

using Eigen::Vector2f;

namespace {

float crossOf(const Vector2f& a, const Vector2f& b) {
  return a.x() * b.y() - a.y() * b.x();
}

}  // namespace

float heightOf(const Corners& quad) {
  return 0.5f * ((quad[3] - quad[0]).norm() + (quad[2] - quad[1]).norm());
}

float widthOf(const Corners& quad) {
  return 0.5f * ((quad[1] - quad[0]).norm() + (quad[2] - quad[3]).norm());
}

float areaOf(const Corners& quad) {
  return 0.5f * std::abs(crossOf(quad[2] - quad[0], quad[3] - quad[1]));
}

Vector2f middleOf(const Corners& quad) {
  return 0.25f * (quad[0] + quad[1] + quad[2] + quad[3]);
}

bool contains(const Corners& quad, const Vector2f& point) {
  for (std::size_t i = 0; i < quad.size(); ++i)
    if (crossOf(quad[(i + 1) % quad.size()] - quad[i], point - quad[i]) < 0) return false;
  return true;
}

Corners grown(const Corners& quad, const Margins& margins) {
  const float height = heightOf(quad);
  const Vector2f right = height * (quad[1] - quad[0] + quad[2] - quad[3]).normalized();
  const Vector2f down = height * (quad[3] - quad[0] + quad[2] - quad[1]).normalized();
  return {quad[0] - margins.left * right - margins.up * down, quad[1] + margins.right * right - margins.up * down,
          quad[2] + margins.right * right + margins.down * down, quad[3] - margins.left * right + margins.down * down};
}

}  // namespace omnimapper::signs
