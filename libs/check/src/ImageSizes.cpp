#include "ImageSizes.h"

#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/obs/CObservationImage.h>

#include <cmath>

namespace omnimapper::check {

namespace {

// Whether the pixels are in memory: others would be read from a file, which another thread may do at the same time.
bool isLoaded(const mrpt::img::CImage& image) {
  return !image.isExternallyStored() && !image.isEmpty();
}

bool isOther(double declared, double size) {
  constexpr double kSame = 0.05;  // of the size: images are cropped by some pixels
  return std::abs(declared - size) > kSame * size;
}

}  // namespace

bool ImageSizeFacts::isScaled() const {
  constexpr double kSameShape = 0.01;
  return std::abs(columns * calibrated_rows / (rows * calibrated_columns) - 1) < kSameShape;
}

std::optional<std::pair<double, double>> otherCalibratedSize(const mrpt::img::TCamera& camera, double columns,
                                                             double rows) {
  if (!(camera.fx() > 0) || camera.fy() == 0 || columns < 1 || rows < 1) return std::nullopt;
  const double across = 2 * camera.cx() + 1, down = 2 * camera.cy() + 1;  // size of which the axis is the centre [px]
  const double declared_columns = camera.ncols, declared_rows = camera.nrows;
  const bool is_nearer = std::abs(across - declared_columns) < std::abs(across - columns) &&
                         std::abs(down - declared_rows) < std::abs(down - rows);
  if (is_nearer && isOther(declared_columns, columns) && isOther(declared_rows, rows))
    return std::pair(declared_columns, declared_rows);
  constexpr double kMuch = 1.7;  // an axis so far from the centre is of another image, whatever size is declared
  const double wider = across / columns, higher = down / rows;
  const bool is_larger = wider > kMuch && higher > kMuch, is_smaller = wider < 1 / kMuch && higher < 1 / kMuch;
  if (!is_larger && !(is_smaller && wider > 0 && higher > 0)) return std::nullopt;
  return std::pair(std::round(across), std::round(down));
}

void ImageSizes::add(const mrpt::obs::CObservation& observation) {
  const auto& label = observation.sensorLabel;
  const auto add_image = [&](const mrpt::img::CImage& image, const mrpt::img::TCamera& camera) {
    if (isLoaded(image))
      add(label, false, camera, static_cast<double>(image.getWidth()), static_cast<double>(image.getHeight()));
  };
  if (const auto* picture = dynamic_cast<const mrpt::obs::CObservationImage*>(&observation))
    return add_image(picture->image, picture->cameraParams);
  const auto* scan = dynamic_cast<const mrpt::obs::CObservation3DRangeScan*>(&observation);
  if (!scan) return;
  if (scan->hasRangeImage)
    add(label, true, scan->cameraParams, static_cast<double>(scan->rangeImage.cols()),
        static_cast<double>(scan->rangeImage.rows()));
  const bool is_registered = scan->cameraParamsIntensity.fx() == 0;
  if (scan->hasIntensityImage)
    add_image(scan->intensityImage, is_registered ? scan->cameraParams : scan->cameraParamsIntensity);
}

void ImageSizes::add(const std::string& label, bool is_depth, const mrpt::img::TCamera& camera, double columns,
                     double rows) {
  constexpr std::size_t kMostLabels = 20;
  const std::pair key(label, is_depth);
  if (counted_.size() >= kMostLabels && counted_.count(key) == 0) return;
  auto& counted = counted_[key];
  ++counted.images;
  const auto other = otherCalibratedSize(camera, columns, rows);
  if (!other || counted.wrong++ > 0) return;
  const double x = columns / other->first, y = rows / other->second;
  counted.first = {label,
                   is_depth,
                   columns,
                   rows,
                   other->first,
                   other->second,
                   x * camera.fx(),
                   y * camera.fy(),
                   (camera.cx() + 0.5) * x - 0.5,
                   (camera.cy() + 0.5) * y - 0.5};
}

std::vector<ImageSizeFacts> ImageSizes::facts() const {
  std::vector<ImageSizeFacts> all;
  for (const auto& [key, counted] : counted_) {
    if (2 * counted.wrong > counted.images) all.push_back(counted.first);
  }
  return all;
}

}  // namespace omnimapper::check
