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
};

/// Some depth images, spread evenly over a log whose length is not known beforehand.
class SampledImages {
 public:
  void add(const std::shared_ptr<const mrpt::obs::CObservation3DRangeScan>& image);
  const std::vector<SampledImage>& all() const { return images_; }
  bool haveNegativeFocal() const { return have_negative_focal_; }

 private:
  std::vector<SampledImage> images_;
  bool have_negative_focal_ = false;
  std::size_t seen_ = 0, stride_ = 1;  // depth images so far; every stride-th is used
};

/// The planes of a depth image; null if it cannot be used.
std::shared_ptr<const obs::CObservationPlanes> planesOf(const mrpt::obs::CObservation3DRangeScan& image);

}  // namespace omnimapper::check
