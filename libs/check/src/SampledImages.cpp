#include "SampledImages.h"

#include <omnimapper/base/Error.h>
#include <omnimapper/perception/PlaneExtractor.h>

#include <cmath>

namespace omnimapper::check {

namespace {

double planesPerImage(const std::vector<SampledImage>& images) {
  std::size_t planes = 0;
  for (const auto& one : images) planes += one.planes->planes.size();
  return images.empty() ? 0 : static_cast<double>(planes) / static_cast<double>(images.size());
}

std::vector<SampledImage> withNoise(const std::vector<SampledImage>& images, double noise) {
  std::vector<SampledImage> all;
  for (const auto& one : images) {
    if (auto planes = planesOf(*one.image, noise)) all.push_back({one.image, std::move(planes), noise});
  }
  return all;
}

}  // namespace

std::shared_ptr<const obs::CObservationPlanes> planesOf(const mrpt::obs::CObservation3DRangeScan& image, double noise) {
  perception::PlaneOptions options;
  options.noise_at_1m *= noise;
  const perception::PlaneExtractor extractor(options, {});
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
  auto planes = planesOf(*used, 1);
  if (!planes) return;
  images_.push_back({used, std::move(planes), 1});
  if (images_.size() < kMost) return;
  std::vector<SampledImage> kept;
  for (std::size_t i = 0; i < images_.size(); i += 2) kept.push_back(images_[i]);
  images_ = std::move(kept);
  stride_ *= 2;
}

std::vector<SampledImage> SampledImages::all() const {
  constexpr double kHardlyAny = 0.5, kSome = 1.5;  // planes per image
  if (planesPerImage(images_) >= kHardlyAny) return images_;
  for (const double noise : {2.0, 4.0}) {
    auto noisy = withNoise(images_, noise);
    if (planesPerImage(noisy) >= kSome) return noisy;
  }
  return images_;
}

}  // namespace omnimapper::check
