#pragma once

#include <mrpt/img/TCamera.h>
#include <mrpt/poses/CPose3D.h>
#include <omnimapper/perception/Extractor.h>

#include <map>
#include <opencv2/core.hpp>
#include <string>

namespace omnimapper::signs {

/// Decides whether an image differs from the last new one of its camera. Both are reduced to 64 columns; the image is
/// new if the difference at some pixel deviates by more than `levels` (of 255 grey levels) from the mean difference,
/// which is attributed to the exposure. An image of another size, of a camera with another pose or calibration, or one
/// that cannot be read, is new too.
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
  std::map<std::string, View> last_;  // by sensor label
};

}  // namespace omnimapper::signs
