#include <omnimapper/base/Error.h>
#include <omnimapper/sim_world/Textures.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "TextureDrawing.h"

namespace omnimapper::sim {

namespace {

// Sets each pixel to `colour(u, v)` at its centre, u to the right and v up in [0, 1].
template <class ColourAt>
Texture paint(int side, const ColourAt& colour) {
  Texture texture = blankTexture(side, side, Colour::Zero());
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) setPixel(texture, x, y, colour((x + 0.5) / side, 1 - (y + 0.5) / side));
  }
  return texture;
}

double fraction(double x) {
  return x - std::floor(x);
}
// 0 at 0 and 1, rising to 1 within `width` of them.
float awayFromEdges(double share, double width) {
  return static_cast<float>(std::clamp(std::min(share, 1 - share) / width, 0.0, 1.0));
}

// A colour with a hue between two limits. It is drawn in several statements, because the compiler chooses the order in
// which the arguments of a call are evaluated.
Colour earthColour(Random& random, double hue_low, double hue_high) {
  const double hue = random.uniform(hue_low, hue_high), saturation = random.uniform(0.4, 0.65);
  return colourOf(hue, saturation, random.uniform(0.45, 0.8));
}

Texture wood(Random& random, int side, int boards) {
  const Colour base = earthColour(random, 0.06, 0.1);
  const PeriodicNoise bend(random, 2, 3, 2), fibre(random, 4, 64, 2);
  std::vector<double> shift, shade;
  for (int i = 0; i < boards; ++i) {
    shift.push_back(random.uniform());
    shade.push_back(random.uniform(0.85, 1.1));
  }
  const double rings = 5;
  return paint(side, [&](double u, double v) {
    const int board = std::min(boards - 1, static_cast<int>(v * boards));
    const double along = u + shift[board];
    const double ring = fraction(rings * (v + 0.15 * bend.at(along, v)));
    float light = 0.78f + 0.18f * awayFromEdges(ring, 0.5) + 0.08f * fibre.at(along, v);
    if (boards > 1) {
      const float seam = awayFromEdges(fraction(v * boards), 0.025) * awayFromEdges(fraction(along), 0.006);
      light *= static_cast<float>(shade[board]) * (0.35f + 0.65f * seam);
    }
    return Colour(light * base);
  });
}

Texture carpet(Random& random, int side) {
  const Colour base = randomColour(random, 0.1, 0.5, 0.25, 0.6);
  const PeriodicNoise patches(random, 4, 4, 3);
  return paint(side, [&](double u, double v) {
    const float fleck = static_cast<float>(random.gaussian(0.12));
    return Colour((1 + 0.15f * patches.at(u, v) + fleck) * base);
  });
}

Texture tiles(Random& random, int side) {
  const int count = 4;
  const Colour base = randomColour(random, 0, 0.2, 0.6, 0.9), joint = Colour::Constant(0.4f);
  std::vector<float> shade;
  for (int i = 0; i < count * count; ++i) shade.push_back(static_cast<float>(random.uniform(0.88, 1.06)));
  const PeriodicNoise marble(random, 6, 6, 4);
  return paint(side, [&](double u, double v) {
    const int tile =
        std::min(count - 1, static_cast<int>(v * count)) * count + std::min(count - 1, static_cast<int>(u * count));
    const float inside = awayFromEdges(fraction(u * count), 0.02) * awayFromEdges(fraction(v * count), 0.02);
    return Colour(inside * (shade[tile] + 0.05f * marble.at(u, v)) * base + (1 - inside) * joint);
  });
}

Texture bricks(Random& random, int side) {
  const int across = 4, up = 12;
  const Colour base = earthColour(random, 0.0, 0.05);
  const Colour mortar = Colour::Constant(0.72f);
  std::vector<float> shade;
  for (int i = 0; i < across * up; ++i) shade.push_back(static_cast<float>(random.uniform(0.75, 1.15)));
  const PeriodicNoise grain(random, 16, 16, 3);
  return paint(side, [&](double u, double v) {
    const int row = std::min(up - 1, static_cast<int>(v * up));
    const double along = fraction(u + (row % 2) * 0.5 / across) * across;
    const int brick = row * across + std::min(across - 1, static_cast<int>(along));
    const float inside = awayFromEdges(fraction(along), 0.03) * awayFromEdges(fraction(v * up), 0.09);
    return Colour(inside * (shade[brick] + 0.12f * grain.at(u, v)) * base + (1 - inside) * mortar);
  });
}

Texture mottled(Random& random, int side, const Colour& base, float coarse, float fine) {
  const PeriodicNoise patches(random, 3, 3, 4);
  return paint(side, [&](double u, double v) {
    return Colour((1 + coarse * patches.at(u, v) + static_cast<float>(random.gaussian(fine))) * base);
  });
}

Texture concrete(Random& random, int side) {
  Texture texture = mottled(random, side, Colour::Constant(static_cast<float>(random.uniform(0.5, 0.7))), 0.12f, 0.03f);
  for (int crack = 0; crack < 3; ++crack) {
    Eigen::Vector2d at{random.uniform(0.1, 0.9) * side, random.uniform(0.1, 0.9) * side};
    double heading = random.uniform(0, 2 * M_PI);
    for (int step = 0; step < 12; ++step) {
      heading += random.gaussian(0.5);
      const Eigen::Vector2d next = at + side / 40.0 * Eigen::Vector2d(std::cos(heading), std::sin(heading));
      drawLine(texture, at, next, side / 256.0, Colour::Constant(0.3f));
      at = next;
    }
  }
  return texture;
}

Texture asphalt(Random& random, int side) {
  const PeriodicNoise patches(random, 3, 3, 3);
  return paint(side, [&](double u, double v) {
    const float grain = random.chance(0.08) ? 0.18f : 0.0f;
    return Colour::Constant(0.2f + 0.04f * patches.at(u, v) + grain + static_cast<float>(random.gaussian(0.025)))
        .eval();
  });
}

Texture cloth(Random& random, int side) {
  const Colour warp = randomColour(random, 0.2, 0.8, 0.3, 0.8), weft = randomColour(random, 0.2, 0.8, 0.3, 0.8);
  const int threads = side / 8;
  return paint(side, [&](double u, double v) {
    const int column = static_cast<int>(u * threads), row = static_cast<int>(v * threads);
    const bool over = ((column + row / 2) & 3) < 2;
    const float round = over ? awayFromEdges(fraction(u * threads), 0.5) : awayFromEdges(fraction(v * threads), 0.5);
    return Colour((0.7f + 0.3f * round + static_cast<float>(random.gaussian(0.02))) * (over ? warp : weft));
  });
}

Texture wallpaper(Random& random, int side) {
  const Colour paper = randomColour(random, 0.05, 0.25, 0.75, 0.95), stripe = 0.92f * paper,
               figure = randomColour(random, 0.3, 0.7, 0.4, 0.7);
  const int stripes = random.integer(3, 6);
  Texture texture = paint(side, [&](double u, double) { return fraction(u * stripes) < 0.5 ? paper : stripe; });
  const double step = static_cast<double>(side) / stripes;
  for (int row = 0; row < stripes; ++row) {
    for (int column = 0; column < stripes; ++column) {
      const double x = (column + 0.25) * step, y = (row + (column % 2 ? 0.3 : 0.7)) * step, r = 0.12 * step;
      fillPolygon(texture, {{x - r, y}, {x, y - 1.6 * r}, {x + r, y}, {x, y + 1.6 * r}}, figure);
      fillDisc(texture, x, y, 0.4 * r, paper);
    }
  }
  return texture;
}

Texture noise(Random& random, int side) {
  const PeriodicNoise red(random, 4, 4, 6), green(random, 4, 4, 6), blue(random, 4, 4, 6);
  return paint(side, [&](double u, double v) {
    return Colour(0.5f + 0.6f * red.at(u, v), 0.5f + 0.6f * green.at(u, v), 0.5f + 0.6f * blue.at(u, v));
  });
}

Texture checker(int side) {
  return paint(side, [](double u, double v) {
    const bool dark = (static_cast<int>(u * 8) + static_cast<int>(v * 8)) % 2 == 0;
    return Colour::Constant(dark ? 0.05f : 0.95f).eval();
  });
}

Texture books(Random& random, int side) {
  Texture texture = blankTexture(side, side, Colour::Constant(0.06f));
  double left = 0;
  while (left < side) {
    const double width = std::min(random.uniform(0.04, 0.11) * side, side - left);
    const double top = random.uniform(0.0, 0.22) * side;
    const Colour cover = randomColour(random, 0.1, 0.9, 0.2, 0.85), print = randomColour(random, 0, 0.5, 0.6, 1);
    fillBox(texture, {left + 0.5, top, left + width - 0.5, 1.0 * side}, cover);
    for (int band = random.integer(1, 3); band > 0; --band) {
      const double y = random.uniform(top, 0.9 * side);
      fillBox(texture, {left + 1, y, left + width - 1, y + random.uniform(0.01, 0.03) * side}, print);
    }
    const double title_top = random.uniform(top, 0.5 * side), title_bottom = title_top + 0.35 * side;
    for (double y = title_top; y < title_bottom; y += 0.025 * side) {
      if (random.chance(0.8)) fillBox(texture, {left + 0.3 * width, y, left + 0.7 * width, y + 0.015 * side}, print);
    }
    left += width;
  }
  return texture;
}

Texture print(Random& random, int side) {
  Texture texture = blankTexture(side, side, randomColour(random, 0.3, 0.9, 0.5, 1));
  for (int i = random.integer(6, 10); i > 0; --i) {
    const Colour colour = randomColour(random, 0.3, 1, 0.2, 1);
    const double x = random.uniform(0.1, 0.9) * side, y = random.uniform(0.1, 0.9) * side,
                 size = random.uniform(0.04, 0.16) * side;
    const int shape = random.integer(0, 3);
    if (shape == 0) fillDisc(texture, x, y, size, colour);
    if (shape == 1) fillBox(texture, {x - size, y - 0.5 * size, x + size, y + 0.5 * size}, colour);
    if (shape == 2) fillPolygon(texture, {{x - size, y + size}, {x + size, y + size}, {x, y - size}}, colour);
    if (shape == 3) drawRing(texture, x, y, 0.8 * size, 0.3 * size, colour);
  }
  for (int i = 0; i < 4; ++i) {
    const double y = (0.72 + 0.06 * i) * side;
    fillBox(texture, {0.1 * side, y, random.uniform(0.5, 0.9) * side, y + 0.02 * side}, Colour::Constant(0.1f));
  }
  return texture;
}

struct NamedTexture {
  const char* name;
  double side;  // [m]
};
// In the order of TextureKind.
constexpr NamedTexture kKinds[] = {{"wood", 0.6},   {"planks", 0.8},    {"carpet", 0.5},   {"tiles", 1.2},
                                   {"bricks", 1.0}, {"plaster", 2.0},   {"concrete", 2.0}, {"asphalt", 1.0},
                                   {"cloth", 0.1},  {"wallpaper", 0.6}, {"noise", 1.0},    {"checker", 0.8},
                                   {"books", 0.5},  {"print", 0.25}};

Texture drawTexture(TextureKind kind, Random& random, int side) {
  switch (kind) {
    case TextureKind::wood:
      return wood(random, side, 1);
    case TextureKind::planks:
      return wood(random, side, 4);
    case TextureKind::carpet:
      return carpet(random, side);
    case TextureKind::tiles:
      return tiles(random, side);
    case TextureKind::bricks:
      return bricks(random, side);
    case TextureKind::plaster:
      return mottled(random, side, randomColour(random, 0, 0.08, 0.8, 0.92), 0.02f, 0.008f);
    case TextureKind::concrete:
      return concrete(random, side);
    case TextureKind::asphalt:
      return asphalt(random, side);
    case TextureKind::cloth:
      return cloth(random, side);
    case TextureKind::wallpaper:
      return wallpaper(random, side);
    case TextureKind::noise:
      return noise(random, side);
    case TextureKind::checker:
      return checker(side);
    case TextureKind::books:
      return books(random, side);
    case TextureKind::print:
      return print(random, side);
  }
  throw std::invalid_argument("unknown kind of texture");
}

}  // namespace

const std::vector<std::string>& textureKindNames() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> list;
    for (const NamedTexture& kind : kKinds) list.emplace_back(kind.name);
    return list;
  }();
  return names;
}

TextureKind textureKindOf(const std::string& name) {
  const auto& names = textureKindNames();
  const auto found = std::find(names.begin(), names.end(), name);
  if (found != names.end()) return static_cast<TextureKind>(found - names.begin());
  std::string known;
  for (const std::string& other : names) known += (known.empty() ? "" : ", ") + other;
  throw base::Error(base::ExitCode::out_of_range, "texture '" + name + "' is unknown; there are " + known);
}

double textureSide(TextureKind kind) {
  return kKinds[static_cast<int>(kind)].side;
}

std::shared_ptr<const Texture> makeTexture(TextureKind kind, std::uint64_t seed, int side) {
  if (side < 16 || side > 1024) throw std::invalid_argument("texture: a side must have 16 to 1024 pixels");
  constexpr std::uint64_t kStream = 0x7e87;
  Random random(seed, {kStream, static_cast<std::uint64_t>(kind)});
  return std::make_shared<const Texture>(drawTexture(kind, random, side));
}

}  // namespace omnimapper::sim
