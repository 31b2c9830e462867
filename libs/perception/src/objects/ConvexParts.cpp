#include "ConvexParts.h"

#include <omnimapper/perception/GrowLabels.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "ClusterPatches.h"
#include "SignedContraction.h"

namespace omnimapper::perception::objects {

namespace {

constexpr float kDegree = static_cast<float>(M_PI) / 180;
constexpr float kConvex = 40 * kDegree;    // angle of a convex border that is an edge rather than a bend
constexpr float kParallel = 30 * kDegree;  // largest angle between the normals of faces that are about parallel
constexpr float kStep = 0.5F;              // sine of the slope from one level to another between parallel faces
constexpr float kAlong = 0.5F;             // squared cosine of 45 deg
constexpr float kSmooth = 1.5F, kEdge = 1, kApart = -1;

// Whether two patches lie one after the other along the line in which their planes meet. Then they do not meet there:
// one is beside the other, mostly before it, and nothing follows from their normals.
bool liesAlong(const Eigen::Vector3f& line, const Eigen::Vector3f& between) {
  const float along = line.dot(between);
  return along * along > kAlong * line.squaredNorm() * between.squaredNorm();
}

// Evidence, for each pair of neighbouring pixels, that two patches belong to the same part: most for a smooth border,
// so that whole faces are joined first, less for a convex edge, and negative for a sharp concave edge or for a step
// between two levels.
float evidence(const Patch& a, const Patch& b, float concave_angle) {
  const float angle = std::acos(std::clamp(a.normal.dot(b.normal), -1.F, 1.F));
  const Eigen::Vector3f between = b.middle - a.middle;
  const float off = std::abs(between.dot((a.normal + b.normal).normalized()));
  if (angle < kParallel && off > kStep * between.norm()) return kApart;
  if (angle > kParallel && liesAlong(a.normal.cross(b.normal), between)) return 0;
  const bool is_concave = (b.normal - a.normal).dot(between) < 0;
  if (is_concave) return kSmooth * (1 - angle / concave_angle);
  return kSmooth + (kEdge - kSmooth) * std::min(1.F, angle / kConvex);
}

}  // namespace

std::vector<std::int32_t> convexParts(const ClusterComparator& near, const NormalImage& normals, double concave_angle,
                                      int fewest) {
  ClusterPatches cut = cutToPatches(near, normals, fewest);
  std::vector<SignedLink> links;
  links.reserve(cut.contacts.size());
  for (const auto& [a, b, pixels] : cut.contacts) {
    const float each = evidence(cut.patches[static_cast<std::size_t>(a)], cut.patches[static_cast<std::size_t>(b)],
                                static_cast<float>(concave_angle));
    const auto length = static_cast<float>(pixels);
    links.push_back({a, b, each * length, length});
  }
  const std::vector<int> parts = contract(cut.patches.size(), links);

  std::vector<int> sizes;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const auto part = static_cast<std::size_t>(parts[i]);
    if (part >= sizes.size()) sizes.resize(part + 1, 0);
    sizes[part] += cut.patches[i].pixels;
  }
  bool some_are_small = false;
  for (std::int32_t& label : cut.labels) {
    if (label == 0) continue;
    const int part = parts[static_cast<std::size_t>(label - 1)];
    const bool is_small = sizes[static_cast<std::size_t>(part)] < fewest;
    some_are_small = some_are_small || is_small;
    label = is_small ? 0 : part + 1;
  }
  if (some_are_small)
    growLabels(near.points.width, near.points.height, near, std::numeric_limits<int>::max(), cut.labels);
  return std::move(cut.labels);
}

}  // namespace omnimapper::perception::objects
