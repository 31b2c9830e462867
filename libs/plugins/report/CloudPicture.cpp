#include "CloudPicture.h"

#include <omnimapper/derived/MapPoints.h>

#include <algorithm>
#include <cmath>

namespace omnimapper::plugins {

namespace {

// The palette has six steps for each colour channel, finer steps of grey, which is the colour of most of a building,
// and the background.
constexpr int kSteps = 6, kColours = kSteps * kSteps * kSteps, kGreys = 39;
constexpr std::uint8_t kPaperIndex = kColours + kGreys;

std::vector<draw::Rgb> coloursAndGreys() {
  const auto level = [](int i, int steps) { return static_cast<std::uint8_t>(255 * i / (steps - 1)); };
  std::vector<draw::Rgb> colours;
  for (int i = 0; i < kColours; ++i)
    colours.push_back(
        {level(i / (kSteps * kSteps), kSteps), level(i / kSteps % kSteps, kSteps), level(i % kSteps, kSteps)});
  for (int i = 0; i < kGreys; ++i) colours.push_back({level(i, kGreys), level(i, kGreys), level(i, kGreys)});
  colours.push_back({226, 231, 237});
  return colours;
}

// The nearest palette entry: the closest colour or the closest grey.
std::uint8_t indexOf(const draw::Rgb& colour, const std::vector<draw::Rgb>& palette) {
  const auto step = [](int value, int steps) { return (value * (steps - 1) + 127) / 255; };
  const int of_colours = (step(colour.r, kSteps) * kSteps + step(colour.g, kSteps)) * kSteps + step(colour.b, kSteps);
  const int of_greys = kColours + step((colour.r + colour.g + colour.b) / 3, kGreys);
  const auto distance = [&](int index) {
    const auto& other = palette[static_cast<std::size_t>(index)];
    const int r = colour.r - other.r, g = colour.g - other.g, b = colour.b - other.b;
    return r * r + g * g + b * b;
  };
  return static_cast<std::uint8_t>(distance(of_greys) < distance(of_colours) ? of_greys : of_colours);
}

double quantileOf(std::vector<double> values, double part) {
  const auto at = values.begin() + std::lround(part * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

std::vector<derived::ColouredPoint> belowCeilings(const map::Map& map, double cube) {
  constexpr double kAbove = 0.5;  // [m]
  derived::PointsOptions options;
  options.voxel = cube;
  auto points = derived::pointsOf(map, options);
  if (points.empty()) return points;
  std::vector<double> bases, heights;
  for (const auto& frame : map.key_frames) bases.push_back(frame.map_from_base.z());
  for (const auto& point : points) heights.push_back(point.in_map.z);
  const double highest = std::max(quantileOf(bases, 0.5), quantileOf(heights, 0.5)) + kAbove;
  points.erase(std::remove_if(points.begin(), points.end(), [&](const auto& p) { return p.in_map.z > highest; }),
               points.end());
  std::stable_sort(points.begin(), points.end(), [](const auto& a, const auto& b) { return a.in_map.z < b.in_map.z; });
  return points;
}

}  // namespace

std::optional<derived::GridPicture> cloudPicture(const map::Map& map, const std::vector<mrpt::math::TPoint3D>& places,
                                                 int side) {
  constexpr double kCube = 0.05, kCut = 0.005;  // [m], share
  if (!derived::hasDepthClouds(map)) return std::nullopt;
  const auto points = belowCeilings(map, kCube);
  if (points.empty()) return std::nullopt;
  std::vector<double> xs, ys;
  for (const auto& point : points) {
    xs.push_back(point.in_map.x);
    ys.push_back(point.in_map.y);
  }
  double left = quantileOf(xs, kCut), right = quantileOf(xs, 1 - kCut);
  double low = quantileOf(ys, kCut), high = quantileOf(ys, 1 - kCut);
  for (const auto& place : places) {
    left = std::min(left, place.x), right = std::max(right, place.x);
    low = std::min(low, place.y), high = std::max(high, place.y);
  }
  const double longer = std::max({right - left, high - low, 0.5});
  const double margin = 0.03 * longer, below = 0.06 * longer;  // wider below for the scale bar
  derived::GridPicture picture;
  picture.metres_per_pixel = longer / side;
  picture.min_x = left - margin;
  picture.max_y = high + margin;
  draw::PaletteImage& image = picture.image;
  const auto pixels = [&](double metres) { return static_cast<int>(std::ceil(metres / picture.metres_per_pixel)); };
  image.width = pixels(right - left + 2 * margin);
  image.height = pixels(high - low + margin + below);
  image.palette = coloursAndGreys();
  image.pixels.assign(static_cast<std::size_t>(image.width) * image.height, kPaperIndex);
  const double half =
      0.7 * kCube / picture.metres_per_pixel;  // squares that touch although points lie anywhere in a cube
  for (const auto& point : points) {
    const auto at = picture.pixelOf(point.in_map.x, point.in_map.y);
    const auto index = indexOf(point.colour, image.palette);
    const auto first = [&](double centre) { return std::max(0, static_cast<int>(std::floor(centre - half))); };
    const auto end = [&](double centre, int size) {
      return std::min(size, static_cast<int>(std::ceil(centre + half)));
    };
    for (int y = first(at.y); y < end(at.y, image.height); ++y) {
      const auto row = image.pixels.begin() + static_cast<std::ptrdiff_t>(y) * image.width;
      for (int x = first(at.x); x < end(at.x, image.width); ++x) row[x] = index;
    }
  }
  return picture;
}

}  // namespace omnimapper::plugins
