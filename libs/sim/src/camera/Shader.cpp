#include "Shader.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace omnimapper::sim {

namespace {

const Eigen::Vector3f kNothing(0.75f, 0.82f, 0.95f);  // bright sky, as seen through a window
constexpr float kLampGrid = 3.0f;                     // between two lamps [m]

struct Lamp {
  Eigen::Vector3f towards;
  Eigen::Vector3f colour;
};

// Two banks of lamps and the light that the floor reflects.
const std::array<Lamp, 3>& lamps() {
  static const std::array<Lamp, 3> list{
      Lamp{Eigen::Vector3f(0.35f, 0.20f, 0.90f).normalized(), Eigen::Vector3f(0.44f, 0.43f, 0.40f)},
      Lamp{Eigen::Vector3f(-0.55f, -0.62f, 0.50f).normalized(), Eigen::Vector3f(0.25f, 0.25f, 0.26f)},
      Lamp{Eigen::Vector3f(0.50f, -0.45f, -0.70f).normalized(), Eigen::Vector3f(0.12f, 0.11f, 0.10f)}};
  return list;
}

Eigen::Vector3f lightAt(const Eigen::Vector3f& place, const Eigen::Vector3f& normal) {
  Eigen::Vector3f light = Eigen::Vector3f::Constant(0.40f + 0.08f * normal.z());
  for (const Lamp& lamp : lamps()) light += std::max(0.0f, normal.dot(lamp.towards)) * lamp.colour;
  const float wave = 2 * static_cast<float>(M_PI) / kLampGrid;
  return light * (1 + 0.10f * std::cos(wave * place.x()) * std::cos(wave * place.y()));
}

}  // namespace

Shader::Shader(const World& world, const Scenes& scenes) : scenes_(scenes), wear_(world) {
  std::map<const Texture*, std::shared_ptr<const TexturePyramid>> made;
  for (const Body& body : world.bodies) {
    for (const Surface& surface : body.surfaces) {
      const Texture* texture = surface.material.texture.get();
      if (texture && !made.count(texture)) made[texture] = std::make_shared<const TexturePyramid>(*texture);
      textures_.push_back(texture ? made.at(texture) : nullptr);
    }
  }
}

// Number of texels that a pixel covers, from its neighbours on the same surface, on the side where it is smaller.
float Shader::footprint(const Frame& frame, int column, int row, const TexturePyramid& texture) const {
  const PixelHit& here = frame.at(column, row);
  const auto step = [&](int dx, int dy) {
    const int x = column + dx, y = row + dy;
    if (x < 0 || y < 0 || x >= frame.camera.width || y >= frame.camera.height) return 1e9f;
    const PixelHit& there = frame.at(x, y);
    if (there.surface != here.surface) return 1e9f;
    const Eigen::Vector2f by = there.texture_at - here.texture_at;
    return by.cwiseProduct(Eigen::Vector2f(texture.width(), texture.height())).norm();
  };
  const float across = std::min(step(1, 0), step(-1, 0)), down = std::min(step(0, 1), step(0, -1));
  if (across >= 1e9f || down >= 1e9f) return std::min({across, down, 1e3f});
  return std::sqrt(across * down);  // on slanted surfaces a compromise between blur and flicker
}

Eigen::Vector3f Shader::colourOf(const PixelHit& hit, const Eigen::Vector3f& along, const Eigen::Vector3f& eye,
                                 float pixel_side, float footprint) const {
  if (hit.surface < 0) return kNothing;
  Eigen::Vector3f colour = scenes_.material(hit.surface).colour;
  if (const auto& texture = textures_[hit.surface])
    colour = colour.cwiseProduct(texture->at(hit.texture_at, footprint));
  const float depth = static_cast<float>(hit.depth);
  const Eigen::Vector3f place = eye + depth * along;
  return wear_.factorAt(hit.surface, place, depth * pixel_side) *
         colour.cwiseProduct(lightAt(place, hit.normal_in_map));
}

std::vector<Eigen::Vector3f> Shader::shade(const Frame& frame) const {
  const Pinhole& camera = frame.camera;
  const Eigen::Matrix3f map_from = frame.map_from_optical.rotation.toRotationMatrix().cast<float>();
  const float pixel_side = static_cast<float>(1 / camera.fx);
  const Eigen::Vector3f eye = frame.map_from_optical.translation.cast<float>();
  const auto along = [&](int column, int row) -> Eigen::Vector3f {
    return map_from * camera.through(column, row).cast<float>();
  };
  std::vector<Eigen::Vector3f> colours(frame.pixels.size());
  for (int row = 0; row < camera.height; ++row) {
    for (int column = 0; column < camera.width; ++column) {
      const PixelHit& hit = frame.at(column, row);
      const bool textured = hit.surface >= 0 && textures_[hit.surface];
      const float texels = textured ? footprint(frame, column, row, *textures_[hit.surface]) : 0;
      colours[static_cast<std::size_t>(row) * camera.width + column] =
          colourOf(hit, along(column, row), eye, pixel_side, texels);
    }
  }
  for (const HitThroughGlass& seen : frame.seen_through) {
    const int row = seen.pixel / camera.width, column = seen.pixel % camera.width;
    constexpr float kUnknown = 2;  // texels: what is behind glass has no neighbours here
    Eigen::Vector3f& colour = colours[seen.pixel];
    colour = (1 - seen.transmission) * colour +
             seen.transmission * colourOf(seen.hit, along(column, row), eye, pixel_side, kUnknown);
  }
  return colours;
}

}  // namespace omnimapper::sim
