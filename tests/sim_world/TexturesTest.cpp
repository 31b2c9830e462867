#include <gtest/gtest.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/sim_world/Textures.h>

#include <cmath>

namespace textures_test {
namespace {

using namespace omnimapper;
using sim::TextureKind;

double contrastOf(const sim::Texture& texture) {
  double sum = 0, squares = 0;
  for (const std::uint8_t value : texture.rgb) sum += value, squares += double(value) * value;
  const double count = static_cast<double>(texture.rgb.size()), mean = sum / count;
  return std::sqrt(squares / count - mean * mean) / 255;
}

// Mean difference between the pixels of a column and the next one.
double stepBetweenColumns(const sim::Texture& texture, int left, int right) {
  double sum = 0;
  for (int y = 0; y < texture.height; ++y) {
    for (int i = 0; i < 3; ++i) {
      sum +=
          std::abs(texture.rgb[3 * (y * texture.width + left) + i] - texture.rgb[3 * (y * texture.width + right) + i]);
    }
  }
  return sum / texture.height / 3;
}

TEST(Textures, kindAndSeedDecideEveryByte) {
  for (const std::string& name : sim::textureKindNames()) {
    const TextureKind kind = sim::textureKindOf(name);
    const auto texture = sim::makeTexture(kind, 3, 64);
    EXPECT_EQ(texture->width, 64) << name;
    EXPECT_EQ(texture->rgb.size(), 64u * 64 * 3) << name;
    EXPECT_EQ(texture->rgb, sim::makeTexture(kind, 3, 64)->rgb) << name;
    if (kind != TextureKind::checker) {
      EXPECT_NE(texture->rgb, sim::makeTexture(kind, 4, 64)->rgb) << name;
    }
    EXPECT_GT(sim::textureSide(kind), 0) << name;
  }
}

TEST(Textures, plasterShowsLittleAndNoiseMuch) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    EXPECT_LT(contrastOf(*sim::makeTexture(TextureKind::plaster, seed)), 0.06);
    EXPECT_GT(contrastOf(*sim::makeTexture(TextureKind::noise, seed)), 0.15);
  }
  EXPECT_NEAR(contrastOf(*sim::makeTexture(TextureKind::checker, 0)), 0.45, 0.01);
}

TEST(Textures, patternsOfNoiseGoOnAcrossTheEdge) {
  for (const TextureKind kind : {TextureKind::noise, TextureKind::plaster, TextureKind::carpet}) {
    const auto texture = sim::makeTexture(kind, 5);
    EXPECT_LT(stepBetweenColumns(*texture, 255, 0), 2 * stepBetweenColumns(*texture, 100, 101) + 1);
  }
}

TEST(Textures, anUnknownKindIsAnErrorThatListsTheKnown) {
  try {
    sim::textureKindOf("marble");
    FAIL();
  } catch (const base::Error& error) {
    EXPECT_EQ(error.code(), base::ExitCode::out_of_range);
    EXPECT_NE(std::string(error.what()).find("wallpaper"), std::string::npos);
  }
  EXPECT_THROW(sim::makeTexture(TextureKind::wood, 0, 8), std::invalid_argument);
}

}  // namespace
}  // namespace textures_test
