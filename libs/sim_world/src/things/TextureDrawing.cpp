#include "TextureDrawing.h"

#include <algorithm>
#include <cmath>

namespace omnimapper::sim {

namespace {

std::size_t indexOf(const Texture& texture, int x, int y) {
  return 3 * (static_cast<std::size_t>(y) * texture.width + x);
}

// Paints each pixel of the box by its share inside the shape. `distance` is that to the border, positive outside.
template <class Distance>
void fillShape(Texture& texture, const Box2& box, const Colour& colour, const Distance& distance) {
  const int left = std::max(0, static_cast<int>(std::floor(box.left)) - 1),
            right = std::min(texture.width, static_cast<int>(std::ceil(box.right)) + 1),
            top = std::max(0, static_cast<int>(std::floor(box.top)) - 1),
            bottom = std::min(texture.height, static_cast<int>(std::ceil(box.bottom)) + 1);
  for (int y = top; y < bottom; ++y) {
    for (int x = left; x < right; ++x) {
      const double share = std::clamp(0.5 - distance(Eigen::Vector2d(x + 0.5, y + 0.5)), 0.0, 1.0);
      if (share > 0) blendPixel(texture, x, y, colour, static_cast<float>(share));
    }
  }
}

}  // namespace

Texture blankTexture(int width, int height, const Colour& colour) {
  Texture texture{width, height, std::vector<std::uint8_t>(3 * static_cast<std::size_t>(width) * height)};
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) setPixel(texture, x, y, colour);
  }
  return texture;
}

void setPixel(Texture& texture, int x, int y, const Colour& colour) {
  std::uint8_t* p = &texture.rgb[indexOf(texture, x, y)];
  for (int i = 0; i < 3; ++i) p[i] = static_cast<std::uint8_t>(std::lround(255 * std::clamp(colour[i], 0.0f, 1.0f)));
}

Colour pixelOf(const Texture& texture, int x, int y) {
  const std::uint8_t* p = &texture.rgb[indexOf(texture, x, y)];
  return Colour(p[0], p[1], p[2]) / 255.0f;
}

void blendPixel(Texture& texture, int x, int y, const Colour& colour, float share) {
  setPixel(texture, x, y, share * colour + (1 - share) * pixelOf(texture, x, y));
}

void fillBox(Texture& texture, const Box2& box, const Colour& colour) {
  fillShape(texture, box, colour, [&](const Eigen::Vector2d& p) {
    return std::max({box.left - p.x(), p.x() - box.right, box.top - p.y(), p.y() - box.bottom});
  });
}

void drawFrame(Texture& texture, const Box2& box, double width, const Colour& colour) {
  fillBox(texture, {box.left, box.top, box.right, box.top + width}, colour);
  fillBox(texture, {box.left, box.bottom - width, box.right, box.bottom}, colour);
  fillBox(texture, {box.left, box.top, box.left + width, box.bottom}, colour);
  fillBox(texture, {box.right - width, box.top, box.right, box.bottom}, colour);
}

void fillDisc(Texture& texture, double x, double y, double radius, const Colour& colour) {
  const Eigen::Vector2d centre(x, y);
  fillShape(texture, {x - radius, y - radius, x + radius, y + radius}, colour,
            [&](const Eigen::Vector2d& p) { return (p - centre).norm() - radius; });
}

void drawRing(Texture& texture, double x, double y, double radius, double width, const Colour& colour) {
  const Eigen::Vector2d centre(x, y);
  const double reach = radius + width;
  fillShape(texture, {x - reach, y - reach, x + reach, y + reach}, colour,
            [&](const Eigen::Vector2d& p) { return std::abs((p - centre).norm() - radius) - width / 2; });
}

void drawLine(Texture& texture, const Eigen::Vector2d& from, const Eigen::Vector2d& to, double width,
              const Colour& colour) {
  const Eigen::Vector2d low = from.cwiseMin(to), high = from.cwiseMax(to), segment = to - from;
  const double squared = std::max(segment.squaredNorm(), 1e-12);
  fillShape(texture, {low.x() - width, low.y() - width, high.x() + width, high.y() + width}, colour,
            [&](const Eigen::Vector2d& p) {
              const double share = std::clamp((p - from).dot(segment) / squared, 0.0, 1.0);
              return (p - from - share * segment).norm() - width / 2;
            });
}

void fillPolygon(Texture& texture, const std::vector<Eigen::Vector2d>& corners, const Colour& colour) {
  Eigen::Vector2d low = corners.front(), high = low, middle(0, 0);
  for (const Eigen::Vector2d& corner : corners) {
    low = low.cwiseMin(corner);
    high = high.cwiseMax(corner);
    middle += corner / static_cast<double>(corners.size());
  }
  fillShape(texture, {low.x(), low.y(), high.x(), high.y()}, colour, [&](const Eigen::Vector2d& p) {
    double outside = -1e9;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Eigen::Vector2d side = corners[(i + 1) % corners.size()] - corners[i];
      Eigen::Vector2d normal = Eigen::Vector2d(side.y(), -side.x()).normalized();
      if (normal.dot(middle - corners[i]) > 0) normal = -normal;
      outside = std::max(outside, normal.dot(p - corners[i]));
    }
    return outside;
  });
}

Colour colourOf(double hue, double saturation, double value) {
  const auto channel = [&](double shift) {
    const double place = std::fmod(shift + hue * 6, 6.0);
    return static_cast<float>(value - value * saturation * std::clamp(std::min(place, 4 - place), 0.0, 1.0));
  };
  return {channel(5), channel(3), channel(1)};
}

Colour randomColour(Random& random, double saturation_low, double saturation_high, double value_low,
                    double value_high) {
  const double hue = random.uniform(), saturation = random.uniform(saturation_low, saturation_high);
  return colourOf(hue, saturation, random.uniform(value_low, value_high));
}

PeriodicNoise::PeriodicNoise(Random& random, int cells_across, int cells_up, int octaves) {
  for (int i = 0; i < octaves; ++i) {
    Octave octave{cells_across << i, cells_up << i, {}};
    for (int k = 0; k < octave.columns * octave.rows; ++k) {
      octave.values.push_back(static_cast<float>(random.uniform(-1, 1)));
    }
    octaves_.push_back(std::move(octave));
  }
}

float PeriodicNoise::at(double u, double v) const {
  float sum = 0, amplitude = 1, whole = 0;
  for (const Octave& octave : octaves_) {
    const double x = (u - std::floor(u)) * octave.columns, y = (v - std::floor(v)) * octave.rows;
    const int left = static_cast<int>(x) % octave.columns, below = static_cast<int>(y) % octave.rows;
    const auto eased = [](double share) { return static_cast<float>(share * share * (3 - 2 * share)); };
    const float across = eased(x - std::floor(x)), up = eased(y - std::floor(y));
    const auto value = [&](int column, int row) {
      return octave.values[static_cast<std::size_t>(row % octave.rows) * octave.columns + column % octave.columns];
    };
    const float low = (1 - across) * value(left, below) + across * value(left + 1, below);
    const float high = (1 - across) * value(left, below + 1) + across * value(left + 1, below + 1);
    sum += amplitude * ((1 - up) * low + up * high);
    whole += amplitude;
    amplitude /= 2;
  }
  return sum / whole * 1.6f;
}

}  // namespace omnimapper::sim
