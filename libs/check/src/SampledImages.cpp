#include "SampledImages.h"

#include <omnimapper/base/Error.h>
#include <omnimapper/perception/PlaneExtractor.h>

#include <cmath>

namespace omnimapper::check {

std::shared_ptr<const obs::CObservationPlanes> planesOf(const mrpt::obs::CObservation3DRangeScan& image) {
  static const perception::PlaneExtractor extractor({}, {});
  try {
    return extractor.extract(image);
  } catch (const base::Error&) {
    return nullptr;  // other findings report images that cannot be used
  }
}

// Images spread over the whole log show most, so every second one is dropped when there are too many.
void SampledImages::add(const std::shared_ptr<const mrpt::obs::CObservation3DRangeScan>& image) {
  constexpr std::size_t kMost = 32;
  if (!image->hasRangeImage || !base::isValid(image->timestamp) || seen_++ % stride_ != 0) return;
  auto used = image;
  if (image->cameraParams.fx() < 0 || image->cameraParams.fy() < 0) {
    auto copy = std::make_shared<mrpt::obs::CObservation3DRangeScan>(*image);
    copy->cameraParams.fx(std::abs(copy->cameraParams.fx()));
    copy->cameraParams.fy(std::abs(copy->cameraParams.fy()));
    used = copy;
    have_negative_focal_ = true;
  }
  auto planes = planesOf(*used);
  if (!planes) return;
  images_.push_back({used, std::move(planes)});
  if (images_.size() < kMost) return;
  std::vector<SampledImage> kept;
  for (std::size_t i = 0; i < images_.size(); i += 2) kept.push_back(images_[i]);
  images_ = std::move(kept);
  stride_ *= 2;
}

}  // namespace omnimapper::check
