#include "Wear.h"

#include <omnimapper/sim_world/Random.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>

namespace omnimapper::sim {

namespace {

constexpr float kLargestPatch = 0.64f;  // [m]
constexpr int kSizes = 7;               // of patches, each half of the one before
// Standard deviation of smoothNoise() over all places.
constexpr float kNoiseSigma = 0.37f;
constexpr std::uint64_t kStream = 0x3ea2;

// Pseudo-random number in [-1, 1] for a corner of a grid.
float valueAt(int x, int y, int z) {
  std::uint32_t bits = static_cast<std::uint32_t>(x) * 0x8da6b343u ^ static_cast<std::uint32_t>(y) * 0xd8163841u ^
                       static_cast<std::uint32_t>(z) * 0xcb1ab31fu;
  bits = (bits ^ (bits >> 16)) * 0x7feb352du;
  bits = (bits ^ (bits >> 15)) * 0x846ca68bu;
  bits ^= bits >> 16;
  return static_cast<float>(bits) * (2.0f / 4294967296.0f) - 1;
}

float smoothNoise(const Eigen::Vector3f& at) {
  const Eigen::Vector3f low = at.array().floor();
  const Eigen::Vector3f along = at - low;
  const Eigen::Vector3f share = along.array().square() * (3 - 2 * along.array());
  const int x = static_cast<int>(low.x()), y = static_cast<int>(low.y()), z = static_cast<int>(low.z());
  float sum = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const int right = corner & 1, up = (corner >> 1) & 1, far = corner >> 2;
    const float weight =
        (right ? share.x() : 1 - share.x()) * (up ? share.y() : 1 - share.y()) * (far ? share.z() : 1 - share.z());
    sum += weight * valueAt(x + right, y + up, z + far);
  }
  return sum;
}

// The grid is rotated, because walls and floors along the map's axes would cut it along its planes.
const Eigen::Matrix3f& gridFromMap() {
  static const Eigen::Matrix3f rotation =
      (Eigen::AngleAxisf(0.7f, Eigen::Vector3f::UnitX()) * Eigen::AngleAxisf(0.5f, Eigen::Vector3f::UnitY()) *
       Eigen::AngleAxisf(0.3f, Eigen::Vector3f::UnitZ()))
          .toRotationMatrix();
  return rotation;
}

bool wears(const Body& body, const Surface& surface) {
  const bool is_to_be_read =
      surface.kind == SurfaceKind::sign || surface.kind == SurfaceKind::poster || surface.kind == SurfaceKind::marker;
  return body.track.isFixed() && !is_to_be_read && surface.material.transmission <= 0;
}

}  // namespace

Wear::Wear(const World& world)
    : amplitude_(static_cast<float>(world.wear) / (kNoiseSigma * std::sqrt(static_cast<float>(kSizes)))) {
  Random random(world.seed, {kStream});
  for (int axis = 0; axis < 3; ++axis) origin_[axis] = static_cast<float>(random.uniform(0, 1000));
  for (const Body& body : world.bodies) {
    for (const Surface& surface : body.surfaces) is_worn_.push_back(amplitude_ > 0 && wears(body, surface));
  }
}

float Wear::factorAt(int surface, const Eigen::Vector3f& in_map, float pixel_side) const {
  if (!is_worn_[surface]) return 1;
  const Eigen::Vector3f in_grid = gridFromMap() * in_map;
  float sum = 0, patch = kLargestPatch;
  for (int size = 0; size < kSizes && patch > pixel_side; ++size, patch /= 2) {
    const float visibility = std::min(1.0f, patch / pixel_side - 1);  // patches of one pixel are averaged away
    sum += visibility * smoothNoise(in_grid / patch + static_cast<float>(size + 1) * origin_);
  }
  return std::max(0.0f, 1 + amplitude_ * sum);
}

}  // namespace omnimapper::sim
