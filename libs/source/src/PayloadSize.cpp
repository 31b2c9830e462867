#include "PayloadSize.h"

#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/obs/CObservationImage.h>
#include <mrpt/obs/CObservationPointCloud.h>
#include <mrpt/obs/CObservationRGBD360.h>
#include <mrpt/obs/CObservationStereoImages.h>

namespace omnimapper::source {

using namespace mrpt::obs;

namespace {

constexpr std::size_t kPoint = 3 * sizeof(float);

std::size_t bytesOf(const mrpt::img::CImage& image) {
  if (image.isEmpty() && !image.isExternallyStored()) return 0;
  return image.getRowStride() * image.getHeight();
}

std::size_t bytesOf(const CObservation3DRangeScan& scan) {
  const auto pixels = static_cast<std::size_t>(scan.rangeImage.size());
  return scan.points3D_x.size() * kPoint +
         pixels * sizeof(scan.rangeImage(0, 0)) * (1 + scan.rangeImageOtherLayers.size());
}

}  // namespace

std::vector<const mrpt::img::CImage*> imagesOf(const CObservation& observation) {
  if (const auto* image = dynamic_cast<const CObservationImage*>(&observation)) return {&image->image};
  if (const auto* stereo = dynamic_cast<const CObservationStereoImages*>(&observation))
    return {&stereo->imageLeft, &stereo->imageRight, &stereo->imageDisparity};
  if (const auto* scan = dynamic_cast<const CObservation3DRangeScan*>(&observation))
    return {&scan->intensityImage, &scan->confidenceImage};
  std::vector<const mrpt::img::CImage*> images;
  if (const auto* ring = dynamic_cast<const CObservationRGBD360*>(&observation))
    for (const auto& image : ring->intensityImages) images.push_back(&image);
  return images;
}

std::size_t payloadBytes(const CObservation& observation) {
  std::size_t bytes = 0;
  for (const auto* image : imagesOf(observation)) bytes += bytesOf(*image);
  if (const auto* scan = dynamic_cast<const CObservation3DRangeScan*>(&observation)) bytes += bytesOf(*scan);
  if (const auto* cloud = dynamic_cast<const CObservationPointCloud*>(&observation)) {
    if (cloud->pointcloud) bytes += cloud->pointcloud->size() * kPoint;
  }
  return bytes;
}

}  // namespace omnimapper::source
