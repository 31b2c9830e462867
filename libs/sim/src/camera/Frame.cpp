#include "Frame.h"

#include <omnimapper/base/Error.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace omnimapper::sim {

namespace {

// Rays of a square of pixels are cast in one call; packets of eight are blocks of 4 x 2 pixels, whose rays take similar
// paths.
constexpr int kTile = 16, kBlockWidth = 4, kBlockHeight = 2;
constexpr double kBehindGlass = 1e-4;  // how far behind a pane the next ray begins [m]
constexpr int kPanes = 6;              // a further pane in a row counts as a wall

template <class Visit>
void forEachOfTile(const Pinhole& camera, int left, int top, Visit visit) {
  const int right = std::min(left + kTile, camera.width), bottom = std::min(top + kTile, camera.height);
  for (int block_row = top; block_row < bottom; block_row += kBlockHeight) {
    for (int block_column = left; block_column < right; block_column += kBlockWidth) {
      for (int row = block_row; row < std::min(block_row + kBlockHeight, bottom); ++row) {
        for (int column = block_column; column < std::min(block_column + kBlockWidth, right); ++column)
          visit(column, row);
      }
    }
  }
}

template <class Visit>
void forEachTile(const Pinhole& camera, Visit visit) {
  for (int top = 0; top < camera.height; top += kTile) {
    for (int left = 0; left < camera.width; left += kTile) visit(left, top);
  }
}

PixelHit pixelHit(const Hit& hit, const Eigen::Vector3d& direction_in_map, double length) {
  PixelHit pixel;
  if (!hit.isHit()) return pixel;
  pixel.depth = hit.range / length;
  pixel.surface = hit.surface;
  pixel.cosine = static_cast<float>(-hit.normal_in_map.dot(direction_in_map));
  pixel.normal_in_map = hit.normal_in_map.cast<float>();
  pixel.texture_at = hit.texture_at;
  return pixel;
}

/// Directions of a camera's pixels in the map, which are linear in the pixel's coordinates.
class Directions {
 public:
  Directions(const Pinhole& camera, const geometry::Se3& map_from_optical) {
    const Eigen::Matrix3d map_from = map_from_optical.rotation.toRotationMatrix();
    right_ = map_from.col(0) / camera.fx;
    down_ = map_from.col(1) / camera.fy;
    first_ = map_from * camera.through(0, 0);
  }
  /// Vector from the camera to the pixel's point at depth 1.
  Eigen::Vector3d at(int column, int row) const { return first_ + column * right_ + row * down_; }

 private:
  Eigen::Vector3d first_, right_, down_;
};

void lookThroughGlass(const Scenes& scenes, const Scene& scene, const Directions& directions, Frame& frame) {
  for (int row = 0; row < frame.camera.height; ++row) {
    for (int column = 0; column < frame.camera.width; ++column) {
      const PixelHit& first = frame.at(column, row);
      if (first.surface < 0 || scenes.material(first.surface).transmission <= 0) continue;
      const Eigen::Vector3d along = directions.at(column, row);
      const double length = along.norm();
      const Ray ray{frame.map_from_optical.translation, along / length};
      const auto [hit, transmission] = castThroughGlass(scenes, scene, ray);
      frame.seen_through.push_back(
          {row * frame.camera.width + column, transmission, pixelHit(hit, ray.direction_in_map, length)});
    }
  }
}

}  // namespace

Frame castFrame(const Scenes& scenes, const Scene& scene, const Pinhole& camera,
                const geometry::Se3& map_from_optical) {
  Frame frame{camera, map_from_optical, std::vector<PixelHit>(camera.count()), {}};
  const Directions directions(camera, map_from_optical);
  std::array<Ray, kTile * kTile> rays;
  std::array<double, kTile * kTile> lengths;
  std::array<Hit, kTile * kTile> hits;
  bool glass = false;
  forEachTile(camera, [&](int left, int top) {
    std::size_t count = 0;
    forEachOfTile(camera, left, top, [&](int column, int row) {
      const Eigen::Vector3d along = directions.at(column, row);
      lengths[count] = along.norm();
      rays[count] = {map_from_optical.translation, along / lengths[count]};
      ++count;
    });
    scene.cast(rays.data(), count, hits.data());
    std::size_t i = 0;
    forEachOfTile(camera, left, top, [&](int column, int row) {
      frame.pixels[static_cast<std::size_t>(row) * camera.width + column] =
          pixelHit(hits[i], rays[i].direction_in_map, lengths[i]);
      glass = glass || (hits[i].isHit() && scenes.material(hits[i].surface).transmission > 0);
      ++i;
    });
  });
  if (glass) lookThroughGlass(scenes, scene, directions, frame);
  return frame;
}

std::pair<Hit, float> castThroughGlass(const Scenes& scenes, const Scene& scene, Ray ray) {
  float light = 1;
  Hit hit;
  for (int pane = 0; pane < kPanes; ++pane) {
    hit = scene.cast(ray);
    if (!hit.isHit() || scenes.material(hit.surface).transmission <= 0) break;
    light *= scenes.material(hit.surface).transmission;
    ray.near = hit.range + kBehindGlass;
  }
  return {hit, light};
}

std::vector<char> findShadow(const Frame& frame, const Scene& scene, const Eigen::Vector3d& other_in_optical) {
  constexpr double kSkin = 1e-3;  // a ray ends this far before its target, which would otherwise block it [m]
  const Pinhole& camera = frame.camera;
  std::vector<char> shadow(camera.count(), 0);
  const Directions directions(camera, frame.map_from_optical);
  const Eigen::Vector3d other = frame.map_from_optical * other_in_optical;
  std::array<Ray, kTile * kTile> rays;
  std::array<std::size_t, kTile * kTile> numbers;
  std::array<char, kTile * kTile> blocked;
  forEachTile(camera, [&](int left, int top) {
    std::size_t count = 0;
    forEachOfTile(camera, left, top, [&](int column, int row) {
      const PixelHit& pixel = frame.at(column, row);
      if (pixel.depth <= 0) return;
      const Eigen::Vector3d to_point =
          frame.map_from_optical.translation + pixel.depth * directions.at(column, row) - other;
      const double length = to_point.norm();
      // A side that faces away from the other point is dark too, which rays that end before it would not find.
      const bool faces_away = to_point.dot(pixel.normal_in_map.cast<double>()) > 0;
      numbers[count] = static_cast<std::size_t>(row) * camera.width + column;
      if (faces_away || length <= kSkin) {
        shadow[numbers[count]] = faces_away;
        return;
      }
      rays[count++] = {other, to_point / length, 0, length - kSkin};
    });
    scene.findBlocked(rays.data(), count, blocked.data());
    for (std::size_t i = 0; i < count; ++i) shadow[numbers[i]] = blocked[i];
  });
  return shadow;
}

std::vector<std::uint16_t> labelsOf(const Frame& frame) {
  std::vector<std::uint16_t> labels(frame.pixels.size());
  for (std::size_t i = 0; i < labels.size(); ++i) {
    const int label = frame.pixels[i].surface + 1;
    if (label > 65535) {
      throw base::Error(
          base::ExitCode::out_of_range,
          "simulated world: label " + std::to_string(label) +
              " does not fit into a label image of 16 bits; leave labels = false or make the world smaller");
    }
    labels[i] = static_cast<std::uint16_t>(label);
  }
  return labels;
}

std::vector<float> exactDepth(const Frame& frame) {
  std::vector<float> depths(frame.pixels.size());
  for (std::size_t i = 0; i < depths.size(); ++i) depths[i] = static_cast<float>(frame.pixels[i].depth);
  return depths;
}

std::vector<std::uint16_t> depthsOf(const Frame& frame, double unit) {
  std::vector<std::uint16_t> depths(frame.pixels.size());
  for (std::size_t i = 0; i < depths.size(); ++i) {
    const double units = frame.pixels[i].depth / unit + 0.5;
    depths[i] = units < 65536 ? static_cast<std::uint16_t>(units) : 0;
  }
  return depths;
}

}  // namespace omnimapper::sim
