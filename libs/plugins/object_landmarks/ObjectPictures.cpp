#include "ObjectPictures.h"

#include <algorithm>
#include <cmath>

namespace omnimapper::plugins {

namespace {

struct Pixel {
  int x, y;
};

// Pixels from (left, top) to before (right, bottom).
struct PixelBox {
  int left, top, right, bottom;
  int width() const { return right - left; }
  int height() const { return bottom - top; }
};

std::optional<Pixel> pixelOf(const Eigen::Vector3f& point_in_sensor, const camera::DepthImage& image) {
  const Eigen::Vector3d point = camera::toOptical(point_in_sensor.cast<double>());
  const camera::Pinhole& camera = image.camera();
  if (!(point.z() > 0.01)) return std::nullopt;
  const double x = camera.fx * point.x() / point.z() + camera.cx, y = camera.fy * point.y() / point.z() + camera.cy;
  if (!(x > -0.5 && x < image.width() - 0.5 && y > -0.5 && y < image.height() - 0.5)) return std::nullopt;
  return Pixel{static_cast<int>(std::lround(x)), static_cast<int>(std::lround(y))};
}

PixelBox around(const std::vector<Pixel>& pixels) {
  PixelBox box{pixels.front().x, pixels.front().y, pixels.front().x, pixels.front().y};
  for (const auto& pixel : pixels) {
    box.left = std::min(box.left, pixel.x);
    box.top = std::min(box.top, pixel.y);
    box.right = std::max(box.right, pixel.x + 1);
    box.bottom = std::max(box.bottom, pixel.y + 1);
  }
  return box;
}

// Which pixels of the box show the object: those near a point that have about its depth. The points may be a selection
// of the object's pixels.
std::vector<std::uint8_t> maskOf(const std::vector<Pixel>& pixels, const PixelBox& box,
                                 const camera::DepthImage& image) {
  constexpr double kAlike = 0.02;  // [m] largest difference of the depths of neighbouring pixels of one object
  const double area = static_cast<double>(box.width()) * box.height();
  const int reach = std::clamp(static_cast<int>(std::ceil(std::sqrt(area / static_cast<double>(pixels.size())))), 1, 6);
  const auto depthAt = [&](int x, int y) { return image.at(static_cast<std::size_t>(y) * image.width() + x); };
  std::vector<std::uint8_t> mask(static_cast<std::size_t>(box.width()) * box.height(), 0);
  for (const auto& pixel : pixels) {
    const double depth = depthAt(pixel.x, pixel.y);
    for (int y = std::max(box.top, pixel.y - reach); y < std::min(box.bottom, pixel.y + reach + 1); ++y) {
      for (int x = std::max(box.left, pixel.x - reach); x < std::min(box.right, pixel.x + reach + 1); ++x) {
        const double there = depthAt(x, y);
        if (there > 0 && std::abs(there - depth) < kAlike)
          mask[static_cast<std::size_t>(y - box.top) * box.width() + (x - box.left)] = 1;
      }
    }
  }
  return mask;
}

std::optional<ObjectPicture> pictureOfObject(const obs::ObservedObject& object, const camera::RgbdView& view) {
  constexpr int kMostSide = 96, kFewest = 50;
  constexpr std::uint8_t kGrey = 225;
  const camera::DepthImage& image = view.depth();
  std::vector<Pixel> pixels;
  for (const auto& point : object.points)
    if (const auto pixel = pixelOf(point, image)) pixels.push_back(*pixel);
  if (pixels.empty()) return std::nullopt;
  const PixelBox box = around(pixels);
  const auto mask = maskOf(pixels, box, image);
  ObjectPicture picture;
  picture.pixels = static_cast<int>(std::count(mask.begin(), mask.end(), 1));
  if (picture.pixels < kFewest) return std::nullopt;
  const int step = (std::max(box.width(), box.height()) + kMostSide - 1) / kMostSide;
  map::Photograph photograph;
  photograph.width = (box.width() + step - 1) / step;
  photograph.height = (box.height() + step - 1) / step;
  for (int y = 0; y < box.height(); y += step) {
    for (int x = 0; x < box.width(); x += step) {
      std::optional<obs::Rgb> colour;
      const std::size_t depth_pixel = static_cast<std::size_t>(box.top + y) * image.width() + (box.left + x);
      if (mask[static_cast<std::size_t>(y) * box.width() + x] != 0)
        colour = view.colours().at(box.left + x, box.top + y, image.at(depth_pixel));
      const obs::Rgb shown = colour.value_or(obs::Rgb{kGrey, kGrey, kGrey});
      photograph.rgb.insert(photograph.rgb.end(), {shown.red, shown.green, shown.blue});
    }
  }
  picture.photograph = std::make_shared<const map::Photograph>(std::move(photograph));
  return picture;
}

}  // namespace

std::vector<std::optional<ObjectPicture>> picturesOf(const obs::CObservationObjects& objects,
                                                     const camera::RgbdView& view) {
  std::vector<std::optional<ObjectPicture>> pictures(objects.objects.size());
  if (!view.colours().exist()) return pictures;
  for (std::size_t i = 0; i < pictures.size(); ++i) pictures[i] = pictureOfObject(objects.objects[i], view);
  return pictures;
}

}  // namespace omnimapper::plugins
