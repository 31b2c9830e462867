#pragma once

#include <mrpt/img/TCamera.h>
#include <mrpt/poses/CPose3D.h>
#include <omnimapper/perception/Extractor.h>

#include <map>
#include <opencv2/core.hpp>
#include <string>

namespace omnimapper::signs {

/// Whether an image shows something that the last new one of its camera did not: both are reduced to 64 columns, and
/// some pixel differs by more than `levels`, of 255 grey levels, from what all of them differ by in the mean, which is
/// the exposure. An image of another size, or of a camera that stands or is calibrated otherwise, is new, and so is one
/// that cannot be read.
class PictureChanges : public perception::Novelty {
 public:
  explicit PictureChanges(double levels) : levels_(levels) {}
  bool isNew(const mrpt::obs::CObservation& raw) override;

 private:
  struct View {
    cv::Mat reduced;  // 32 bit floats
    cv::Size size;
    mrpt::img::TCamera camera;
    mrpt::poses::CPose3D pose;
  };
  static View viewOf(const mrpt::obs::CObservation& raw);
  bool areAlike(const View& a, const View& b) const;

  double levels_;
  std::map<std::string, View> last_;  // by sensor
};

}  // namespace omnimapper::signs
