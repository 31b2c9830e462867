#pragma once

#include <mrpt/obs/CObservation3DRangeScan.h>
#include <omnimapper/obs/CObservationPlanes.h>

#include <memory>
#include <vector>

namespace omnimapper::check {

/// A depth image and its planes. If a focal length was negative, the image is a copy with positive ones.
struct SampledImage {
  std::shared_ptr<const mrpt::obs::CObservation3DRangeScan> image;
  std::shared_ptr<const obs::CObservationPlanes> planes;
  double noise = 1;  ///< of the depths, with which the planes were found: a factor on that of the extractor's defaults
};

/// Some depth images, spread evenly over a log whose length is not known beforehand.
class SampledImages {
 public:
  void add(const std::shared_ptr<const mrpt::obs::CObservation3DRangeScan>& image);
  /// The images, with the planes that are found at the extractor's default noise. Where hardly any image shows one, as
  /// small or noisy images do, with those that are found at twice or four times the noise, if they are many more.
  std::vector<SampledImage> all() const;
  bool haveNegativeFocal() const { return have_negative_focal_; }

 private:
  std::vector<SampledImage> images_;
  bool have_negative_focal_ = false;
  std::size_t seen_ = 0, stride_ = 1;  // depth images so far; every stride-th is used
};

/// The planes of a depth image at `noise` times the extractor's default noise; null if it cannot be used.
std::shared_ptr<const obs::CObservationPlanes> planesOf(const mrpt::obs::CObservation3DRangeScan& image, double noise);

}  // namespace omnimapper::check
