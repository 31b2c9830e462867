#include "back_end/KeptObservations.h"

#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/obs/CObservationImage.h>
#include <mrpt/obs/CObservationStereoImages.h>

#include <algorithm>
#include <memory>

namespace omnimapper::mapper {

namespace {

using namespace mrpt::obs;

template <class Observation>
std::shared_ptr<Observation> withSameHead(const Observation& of) {
  auto made = Observation::Create();
  made->timestamp = of.timestamp;
  made->sensorLabel = of.sensorLabel;
  return made;
}

CObservation::ConstPtr stripped(const CObservation3DRangeScan& scan, RawImages kept) {
  const bool has_more = scan.hasIntensityImage || scan.hasConfidenceImage || scan.hasPoints3D ||
                        scan.hasPixelLabels() || !scan.rangeImageOtherLayers.empty();
  if (kept == RawImages::depth ? !has_more : !has_more && !scan.hasRangeImage) return nullptr;
  auto made = withSameHead(scan);
  made->sensorPose = scan.sensorPose;
  made->cameraParams = scan.cameraParams;
  made->cameraParamsIntensity = scan.cameraParamsIntensity;
  made->relativePoseIntensityWRTDepth = scan.relativePoseIntensityWRTDepth;
  made->maxRange = scan.maxRange;
  made->stdError = scan.stdError;
  made->range_is_depth = scan.range_is_depth;
  made->rangeUnits = scan.rangeUnits;
  if (kept == RawImages::none) return made;
  made->hasRangeImage = scan.hasRangeImage;
  made->rangeImage = scan.rangeImage;
  return made;
}

CObservation::ConstPtr stripped(const CObservationImage& image) {
  if (image.image.isEmpty()) return nullptr;
  auto made = withSameHead(image);
  made->cameraPose = image.cameraPose;
  made->cameraParams = image.cameraParams;
  return made;
}

CObservation::ConstPtr stripped(const CObservationStereoImages& images) {
  if (images.imageLeft.isEmpty() && !images.hasImageRight && !images.hasImageDisparity) return nullptr;
  auto made = withSameHead(images);
  made->leftCamera = images.leftCamera;
  made->rightCamera = images.rightCamera;
  made->cameraPose = images.cameraPose;
  made->rightCameraPose = images.rightCameraPose;
  made->hasImageRight = made->hasImageDisparity = false;
  return made;
}

// A copy without the images that are not kept; null if there is nothing to remove.
CObservation::ConstPtr stripped(const CObservation& observation, RawImages kept) {
  if (const auto* scan = dynamic_cast<const CObservation3DRangeScan*>(&observation)) return stripped(*scan, kept);
  if (const auto* image = dynamic_cast<const CObservationImage*>(&observation)) return stripped(*image);
  if (const auto* images = dynamic_cast<const CObservationStereoImages*>(&observation)) return stripped(*images);
  return nullptr;
}

}  // namespace

bool KeptObservations::takes(const map::KeyFrame& frame, const map::CloudPoint& point) {
  const auto in_map = frame.map_from_base.composePoint(point.inBase());
  return cubes_.insert(in_map.x, in_map.y, in_map.z);
}

void KeptObservations::posesChanged() {
  const bool is_as_it_was = std::all_of(map_.key_frames.begin(), map_.key_frames.end(), [this](const auto& frame) {
    const auto seen = seen_from_.find(frame.id);
    if (seen == seen_from_.end()) return frame.cloud.empty();
    constexpr double kLever = 3;  // [m] distance at which a rotation counts by how far it moves a point
    const auto far = [&](const mrpt::poses::CPose3D& pose) { return pose.composePoint({kLever, 0, 0}); };
    const auto side = [&](const mrpt::poses::CPose3D& pose) { return pose.composePoint({0, kLever, 0}); };
    return (far(frame.map_from_base) - far(seen->second)).norm() < cloud_.voxel &&
           (side(frame.map_from_base) - side(seen->second)).norm() < cloud_.voxel;
  });
  if (is_as_it_was) return;
  cubes_.clear();
  seen_from_.clear();
  for (const auto& frame : map_.key_frames) {
    if (frame.cloud.empty()) continue;
    seen_from_[frame.id] = frame.map_from_base;
    for (const auto& point : frame.cloud) takes(frame, point);
  }
}

void KeptObservations::addCloud(base::KeyFrameId id, const std::vector<map::CloudPoint>& points) {
  if (points.empty()) return;
  auto& frame = map_.key_frames.edit(id);
  seen_from_[id] = frame.map_from_base;
  for (const auto& point : points) {
    if (takes(frame, point)) frame.cloud.push_back(point);
  }
}

void KeptObservations::dropImages(base::KeyFrameId id) {
  if (images_ == RawImages::all) return;
  for (auto& observation : map_.key_frames.edit(id).observations) {
    if (auto kept = stripped(*observation, images_)) observation = std::move(kept);
  }
}

}  // namespace omnimapper::mapper
