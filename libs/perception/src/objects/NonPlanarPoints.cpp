#include "NonPlanarPoints.h"

#include <omnimapper/perception/SameLabel.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "../planes/Lanes.h"

namespace omnimapper::perception::objects {

namespace {

using planes::kLanes;
using planes::Lanes;

constexpr int kBlock = 512;  // points that stay in the cache for all surfaces

// Pixels with a depth that belong to no surface and no other large plane, and their points [m], followed by eight
// zeros.
struct UnassignedPoints {
  int count = 0;
  std::unique_ptr<int[]> pixels;
  std::unique_ptr<float[]> x, y, z;

  UnassignedPoints(const std::vector<std::uint16_t>& labels, const OrganizedPoints& points,
                   const std::vector<std::uint8_t>& of_place) {
    pixels.reset(new int[labels.size()]);
    for (auto* of_pixels : {&x, &y, &z}) of_pixels->reset(new float[labels.size() + kLanes]);
    const auto end = static_cast<int>(labels.size());
    for (int begin = 0; begin < end;) {
      const std::uint16_t label = labels[static_cast<std::size_t>(begin)];
      const int end_of_label = endOfLabel(labels.data(), label, begin, end);
      if (of_place[label] == 0) add(points, begin, end_of_label);
      begin = end_of_label;
    }
    for (auto* of_pixels : {&x, &y, &z}) std::fill_n(of_pixels->get() + count, kLanes, 0.F);
  }

  Eigen::Vector3d point(int k) const { return Eigen::Vector3f(x[k], y[k], z[k]).cast<double>(); }

 private:
  // Each point is written, but counted only if it has a depth. This avoids a branch, which holes make unpredictable.
  void add(const OrganizedPoints& points, int begin, int end) {
    const float *const from_x = points.x.data(), *const from_y = points.y.data(), *const from_z = points.z.data();
    for (int i = begin; i < end; ++i) {
      pixels[count] = i;
      x[count] = from_x[i];
      y[count] = from_y[i];
      z[count] = from_z[i];
      count += std::isnan(from_z[i]) ? 0 : 1;
    }
  }
};

struct PlaneInFloats {
  float a, b, c, d;
};

struct BlockTask {
  const PlaneInFloats* pieces;
  int piece_count;
  float height, noise_at_1m;
  const float *x, *y, *z;
  int count;
};

// Distances [m] of points from the nearest piece of a surface, minus the largest distance of points that belong to it;
// 0 where that is positive.
OMNIMAPPER_KERNEL_BODY void excessBody(const BlockTask& task, float* excess) {
  for (int k = 0; k < task.count; k += kLanes) {
    Lanes x, y, z;
    planes::load(x, task.x + k);
    planes::load(y, task.y + k);
    planes::load(z, task.z + k);
    const Lanes noise = task.noise_at_1m * z * z;
    Lanes least{};
    for (const PlaneInFloats* piece = task.pieces; piece < task.pieces + task.piece_count; ++piece) {
      const Lanes signed_distance = piece->a * x + piece->b * y + piece->c * z + piece->d;
      const Lanes distance = signed_distance < 0.F ? -signed_distance : signed_distance;
      const Lanes here = distance - task.height - noise;
      least = here < least ? here : least;
    }
    planes::store(least, excess + k);
  }
}

#ifdef OMNIMAPPER_KERNEL_AVX2
OMNIMAPPER_KERNEL_AVX2 void excessAvx2(const BlockTask& task, float* excess) {
  excessBody(task, excess);
}
#endif

void computeExcess(const BlockTask& task, float* excess) {
#ifdef OMNIMAPPER_KERNEL_AVX2
  if (planes::hasAvx2()) return excessAvx2(task, excess);
#endif
  excessBody(task, excess);
}

std::vector<PlaneInFloats> piecesOf(const Surface& surface, const PlaneSegmentation& planes) {
  std::vector<PlaneInFloats> pieces;
  for (const int piece : surface.pieces) {
    const auto& plane = planes.planes[static_cast<std::size_t>(piece)].plane_in_sensor;
    const Eigen::Vector3f n = plane.normal.cast<float>();
    pieces.push_back({n.x(), n.y(), n.z(), static_cast<float>(plane.distance)});
  }
  return pieces;
}

}  // namespace

std::vector<std::uint16_t> assignToSurfaces(const PlaneSegmentation& planes, const OrganizedPoints& points,
                                            const std::vector<Surface>& surfaces,
                                            const std::vector<std::uint8_t>& of_place, const SurfaceBounds& bounds) {
  std::vector<std::uint16_t> labels = planes.labels;
  if (surfaces.empty()) return labels;
  const UnassignedPoints unassigned(labels, points, of_place);
  std::vector<std::vector<PlaneInFloats>> pieces;
  for (const Surface& surface : surfaces) pieces.push_back(piecesOf(surface, planes));
  float excess[kBlock];
  for (int first = 0; first < unassigned.count; first += kBlock) {
    const int count = std::min(kBlock, unassigned.count - first);
    for (std::size_t s = 0; s < surfaces.size(); ++s) {
      const Surface& surface = surfaces[s];
      computeExcess({pieces[s].data(), static_cast<int>(pieces[s].size()), bounds.height, bounds.noise_at_1m,
                     &unassigned.x[first], &unassigned.y[first], &unassigned.z[first], count},
                    excess);
      for (int k = 0; k < count; ++k) {
        if (excess[k] >= 0) continue;
        if (surface.hull.holds(surface.across.transpose() * unassigned.point(first + k), bounds.hull_margin))
          labels[static_cast<std::size_t>(unassigned.pixels[first + k])] =
              static_cast<std::uint16_t>(surface.plane + 1);
      }
    }
  }
  return labels;
}

}  // namespace omnimapper::perception::objects
