#include "StraightImage.h"

#include <utility>

namespace omnimapper::plugins {

StraightImage::StraightImage(ScanPtr scan, const camera::LensStraightener& lens)
    : scan_(std::move(scan)), straight_(lens.straightened(scan_)), view_(*straight_) {}

const matching::RgbdPyramid& StraightImage::pyramid() const {
  if (!pyramid_) pyramid_.emplace(view_.depth(), view_.colour());
  return *pyramid_;
}

void StraightImage::share(const std::shared_ptr<const StraightImage>& image, perception::Blackboard& board) {
  board.put(image);
  if (image->straight_ == image->scan_) board.put(std::shared_ptr<const camera::RgbdView>(image, &image->view_));
}

}  // namespace omnimapper::plugins
