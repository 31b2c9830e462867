#include <omnimapper/camera/RangeScan.h>
#include <omnimapper/camera/RgbdView.h>

namespace omnimapper::camera {

struct RgbdView::Parts {
  explicit Parts(const mrpt::obs::CObservation3DRangeScan& scan) : depth(scan), colours(scan) {}

  ScanDepth depth;
  ScanColours colours;
  std::vector<obs::Rgb> in_depth_view;  // colours of a picture that was taken from another view
  ColourImage picture;
};

RgbdView::RgbdView(const mrpt::obs::CObservation3DRangeScan& scan) : parts_(std::make_unique<Parts>(scan)) {
  if (!parts_->colours.exist()) return;
  if (parts_->colours.areOfDepthView()) {
    parts_->picture = parts_->colours.picture();
    return;
  }
  static_assert(sizeof(obs::Rgb) == 3, "pixels must be contiguous");
  const auto& image = parts_->depth.image();
  parts_->in_depth_view = parts_->colours.inDepthView(parts_->depth);
  if (parts_->in_depth_view.empty()) return;
  parts_->picture = {&parts_->in_depth_view.data()->red, image.width(), image.height(), 3 * image.width(),
                     ColourImage::Order::rgb};
}

RgbdView::~RgbdView() = default;

const DepthImage& RgbdView::depth() const {
  return parts_->depth.image();
}

const ColourImage* RgbdView::colour() const {
  return parts_->picture.pixels == nullptr ? nullptr : &parts_->picture;
}

}  // namespace omnimapper::camera
