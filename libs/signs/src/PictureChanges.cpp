#include "PictureChanges.h"

#include <mrpt/img/CImage.h>
#include <omnimapper/camera/PictureView.h>

#include <algorithm>
#include <exception>
#include <opencv2/imgproc.hpp>
#include <utility>

namespace omnimapper::signs {

// An image that cannot be read gives an empty reduced image; the extractor reports why.
PictureChanges::View PictureChanges::viewOf(const mrpt::obs::CObservation& raw) {
  constexpr int kColumns = 64;
  View view;
  try {
    const auto picture = camera::pictureOf(raw);
    if (picture.image == nullptr) return view;
    const auto pixels = picture.image->asCvMat<cv::Mat>(mrpt::img::SHALLOW_COPY);
    if (pixels.depth() != CV_8U || (pixels.channels() != 1 && pixels.channels() != 3)) return view;
    cv::Mat reduced;
    const int rows = std::max(1, kColumns * pixels.rows / pixels.cols);
    cv::resize(pixels, reduced, {kColumns, rows}, 0, 0, cv::INTER_AREA);
    if (reduced.channels() == 3) cv::cvtColor(reduced, reduced, cv::COLOR_BGR2GRAY);
    reduced.convertTo(view.reduced, CV_32F);
    view.size = pixels.size();
    view.camera = *picture.camera;
    view.pose = picture.pose;
  } catch (const std::exception&) {
  }
  return view;
}

bool PictureChanges::areAlike(const View& a, const View& b) const {
  if (a.reduced.empty() || a.size != b.size || !(a.camera == b.camera) || a.pose != b.pose) return false;
  const cv::Mat difference = a.reduced - b.reduced;
  double least = 0, most = 0;
  cv::minMaxLoc(difference, &least, &most);
  const double mean = cv::mean(difference)[0];
  return std::max(most - mean, mean - least) <= levels_;
}

bool PictureChanges::isNew(const mrpt::obs::CObservation& raw) {
  View view = viewOf(raw);
  View& last = last_[raw.sensorLabel];
  if (areAlike(view, last)) return false;
  last = std::move(view);
  return true;
}

}  // namespace omnimapper::signs
