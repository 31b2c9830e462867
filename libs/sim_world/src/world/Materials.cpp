#include <omnimapper/base/Config.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/sim_world/Materials.h>
#include <omnimapper/sim_world/Textures.h>

#include <algorithm>
#include <map>
#include <mutex>

namespace omnimapper::sim {

namespace {

struct Row {
  const char* name;
  float red, green, blue;  // linear
  float infrared, transmission;
  float tile;  // width and height of one picture of its texture [m]
};

// Infrared values are what dull surfaces reflect near 0.9 um, where dyes of cloth are bright and carbon black is not.
constexpr Row kRows[] = {
    {"paint_white", 0.78f, 0.77f, 0.73f, 0.80f, 0, 1.5f},
    {"paint_cream", 0.80f, 0.72f, 0.54f, 0.78f, 0, 1.5f},
    {"paint_blue", 0.32f, 0.45f, 0.58f, 0.70f, 0, 1.5f},
    {"paint_green", 0.42f, 0.55f, 0.38f, 0.70f, 0, 1.5f},
    {"paint_grey", 0.48f, 0.49f, 0.50f, 0.65f, 0, 1.5f},
    {"paint_red", 0.52f, 0.16f, 0.12f, 0.65f, 0, 1.5f},
    {"ceiling_white", 0.82f, 0.82f, 0.80f, 0.80f, 0, 0.6f},
    {"tiles_white", 0.75f, 0.77f, 0.78f, 0.75f, 0, 0.6f},
    {"tiles_grey", 0.36f, 0.37f, 0.38f, 0.55f, 0, 0.6f},
    {"wood_floor", 0.42f, 0.26f, 0.13f, 0.60f, 0, 1.2f},
    {"carpet_blue", 0.10f, 0.14f, 0.24f, 0.45f, 0, 1.0f},
    {"carpet_grey", 0.18f, 0.18f, 0.17f, 0.45f, 0, 1.0f},
    {"linoleum", 0.46f, 0.44f, 0.36f, 0.60f, 0, 1.5f},
    {"concrete", 0.40f, 0.39f, 0.37f, 0.55f, 0, 2.0f},
    {"door_wood", 0.46f, 0.27f, 0.12f, 0.65f, 0, 1.0f},
    {"door_grey", 0.34f, 0.36f, 0.38f, 0.55f, 0, 1.0f},
    {"oak", 0.50f, 0.33f, 0.17f, 0.65f, 0, 1.0f},
    {"walnut", 0.20f, 0.11f, 0.06f, 0.55f, 0, 1.0f},
    {"birch", 0.66f, 0.52f, 0.34f, 0.70f, 0, 1.0f},
    {"white_board", 0.85f, 0.85f, 0.85f, 0.80f, 0, 1.0f},
    {"laminate_grey", 0.52f, 0.52f, 0.52f, 0.65f, 0, 1.0f},
    {"stone_worktop", 0.16f, 0.15f, 0.15f, 0.35f, 0, 0.6f},
    {"steel", 0.45f, 0.46f, 0.48f, 0.50f, 0, 0.8f},
    {"black_metal", 0.03f, 0.03f, 0.03f, 0.08f, 0, 0.8f},
    {"black_plastic", 0.03f, 0.03f, 0.03f, 0.05f, 0, 0.5f},
    {"enamel_white", 0.82f, 0.82f, 0.82f, 0.80f, 0, 0.8f},
    {"cloth_red", 0.40f, 0.07f, 0.06f, 0.60f, 0, 0.5f},
    {"cloth_blue", 0.07f, 0.13f, 0.34f, 0.55f, 0, 0.5f},
    {"cloth_green", 0.10f, 0.25f, 0.10f, 0.55f, 0, 0.5f},
    {"cloth_grey", 0.24f, 0.24f, 0.25f, 0.50f, 0, 0.5f},
    {"cloth_beige", 0.56f, 0.47f, 0.34f, 0.65f, 0, 0.5f},
    {"cloth_black", 0.02f, 0.02f, 0.02f, 0.05f, 0, 0.5f},
    {"linen_white", 0.78f, 0.77f, 0.74f, 0.80f, 0, 0.5f},
    {"leather_brown", 0.20f, 0.09f, 0.04f, 0.45f, 0, 0.5f},
    {"cardboard", 0.44f, 0.30f, 0.17f, 0.65f, 0, 0.4f},
    {"plastic_red", 0.55f, 0.05f, 0.04f, 0.60f, 0, 0.3f},
    {"plastic_blue", 0.05f, 0.14f, 0.50f, 0.55f, 0, 0.3f},
    {"plastic_green", 0.08f, 0.38f, 0.12f, 0.55f, 0, 0.3f},
    {"plastic_yellow", 0.75f, 0.52f, 0.05f, 0.65f, 0, 0.3f},
    {"plant", 0.06f, 0.20f, 0.04f, 0.70f, 0, 0.3f},
    {"clay", 0.42f, 0.17f, 0.08f, 0.55f, 0, 0.3f},
    {"glass", 0.70f, 0.78f, 0.76f, 0.10f, 0.90f, 1.0f},
    {"screen", 0.02f, 0.02f, 0.03f, 0.05f, 0, 0.5f},
    {"asphalt", 0.09f, 0.09f, 0.09f, 0.25f, 0, 2.0f},
    {"pavement", 0.36f, 0.34f, 0.31f, 0.50f, 0, 1.2f},
    {"kerb_stone", 0.50f, 0.49f, 0.46f, 0.55f, 0, 1.0f},
    {"brick", 0.36f, 0.14f, 0.09f, 0.50f, 0, 1.2f},
    {"plaster", 0.62f, 0.55f, 0.42f, 0.65f, 0, 2.0f},
    {"grass", 0.07f, 0.16f, 0.03f, 0.65f, 0, 1.0f},
    {"bark", 0.14f, 0.09f, 0.06f, 0.50f, 0, 0.5f},
    {"car_red", 0.42f, 0.03f, 0.03f, 0.45f, 0, 1.0f},
    {"car_silver", 0.50f, 0.51f, 0.53f, 0.50f, 0, 1.0f},
    {"car_blue", 0.04f, 0.08f, 0.28f, 0.40f, 0, 1.0f},
};

struct TextureRow {
  const char* material;
  TextureKind kind;
};
constexpr TextureRow kTextureRows[] = {
    {"paint_white", TextureKind::plaster},
    {"paint_cream", TextureKind::plaster},
    {"paint_blue", TextureKind::plaster},
    {"paint_green", TextureKind::plaster},
    {"paint_grey", TextureKind::plaster},
    {"plaster", TextureKind::plaster},
    {"tiles_white", TextureKind::tiles},
    {"tiles_grey", TextureKind::tiles},
    {"wood_floor", TextureKind::planks},
    {"carpet_blue", TextureKind::carpet},
    {"carpet_grey", TextureKind::carpet},
    {"linoleum", TextureKind::carpet},
    {"concrete", TextureKind::concrete},
    {"door_wood", TextureKind::wood},
    {"oak", TextureKind::wood},
    {"walnut", TextureKind::wood},
    {"birch", TextureKind::wood},
    {"stone_worktop", TextureKind::concrete},
    {"cloth_red", TextureKind::cloth},
    {"cloth_blue", TextureKind::cloth},
    {"cloth_green", TextureKind::cloth},
    {"cloth_grey", TextureKind::cloth},
    {"cloth_beige", TextureKind::cloth},
    {"cardboard", TextureKind::print},
    {"plant", TextureKind::noise},
    {"asphalt", TextureKind::asphalt},
    {"pavement", TextureKind::tiles},
    {"kerb_stone", TextureKind::concrete},
    {"brick", TextureKind::bricks},
    {"grass", TextureKind::noise},
    {"bark", TextureKind::noise},
};

// A texture multiplies the colour. This is the colour that gives the wanted one together with the texture's mean.
Eigen::Vector3f withoutMean(const Eigen::Vector3f& colour, const Texture& texture) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < texture.rgb.size(); ++i) sum[static_cast<int>(i % 3)] += texture.rgb[i] / 255.0;
  const Eigen::Vector3f mean = (sum / (texture.rgb.size() / 3)).cast<float>();
  return colour.cwiseQuotient(mean.cwiseMax(0.05f)).cwiseMin(1.0f);
}

NamedMaterial make(const Row& row) {
  NamedMaterial named{{{row.red, row.green, row.blue}, nullptr, row.infrared, row.transmission},
                      {{row.tile, row.tile}}};
  for (const TextureRow& texture : kTextureRows) {
    if (std::string(texture.material) != row.name) continue;
    named.material.texture = makeTexture(texture.kind, static_cast<std::uint64_t>(&row - kRows));
    named.material.colour = withoutMean(named.material.colour, *named.material.texture);
    const double side = textureSide(texture.kind);
    named.layout.tile = {side, side};
  }
  return named;
}

}  // namespace

const std::vector<std::string>& materialNames() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> result;
    for (const Row& row : kRows) result.emplace_back(row.name);
    return result;
  }();
  return names;
}

std::optional<NamedMaterial> findMaterial(const std::string& name) {
  // The texture of a material is drawn once and shared by all surfaces of that material.
  static std::mutex mutex;
  static std::map<std::string, NamedMaterial> made;
  const std::lock_guard lock(mutex);
  for (const Row& row : kRows) {
    if (name != row.name) continue;
    const auto known = made.find(name);
    return known != made.end() ? known->second : made.emplace(name, make(row)).first->second;
  }
  return {};
}

NamedMaterial materialNamed(const std::string& name) {
  if (const auto material = findMaterial(name)) return *material;
  throw base::Error(base::ExitCode::out_of_range, sayUnknownMaterial(name));
}

std::string sayUnknownMaterial(const std::string& name) {
  const std::string near = base::nearestName(name, materialNames());
  return "no material is called '" + name + "'; " +
         (near.empty() ? "there are " + base::option_text::format(materialNames()) : "did you mean '" + near + "'?");
}

}  // namespace omnimapper::sim
