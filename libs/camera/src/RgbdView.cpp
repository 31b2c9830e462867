#include <omnimapper/camera/RgbdView.h>

#include <optional>

namespace omnimapper::camera {

struct RgbdView::Parts {
  explicit Parts(const mrpt::obs::CObservation3DRangeScan& scan) : depth(scan), colours(scan) {}

  ScanDepth depth;
  ScanColours colours;
  std::optional<std::vector<obs::Rgb>> of_depths;  // once it was requested
  ColourImage picture;                             // in the view of the depths, once it was requested
};

RgbdView::RgbdView(const mrpt::obs::CObservation3DRangeScan& scan) : parts_(std::make_unique<Parts>(scan)) {
  if (parts_->colours.areOfDepthView()) parts_->picture = parts_->colours.picture();
}

RgbdView::~RgbdView() = default;

const DepthImage& RgbdView::depth() const {
  return parts_->depth.image();
}

const ScanColours& RgbdView::colours() const {
  return parts_->colours;
}

const std::vector<obs::Rgb>& RgbdView::coloursOfDepths() const {
  if (!parts_->of_depths) parts_->of_depths = parts_->colours.inDepthView(parts_->depth);
  return *parts_->of_depths;
}

const ColourImage* RgbdView::colour() const {
  ColourImage& picture = parts_->picture;
  if (picture.pixels != nullptr) return &picture;
  if (!parts_->colours.exist() || coloursOfDepths().empty()) return nullptr;
  static_assert(sizeof(obs::Rgb) == 3, "pixels must be contiguous");
  const int width = depth().width();
  picture = {&coloursOfDepths().data()->red, width, depth().height(), 3 * width, ColourImage::Order::rgb};
  return &picture;
}

}  // namespace omnimapper::camera
