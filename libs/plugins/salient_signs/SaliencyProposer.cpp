#include "SaliencyProposer.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <opencv2/saliency.hpp>

#include "Pixels.h"
#include "Plate.h"

namespace omnimapper::signs {

namespace {

constexpr double kSame = 0.9;      // smallest overlap of two regions that count as one
constexpr double kSameBox = 0.8;   // smallest overlap of two components that count as one, before plates are fitted
constexpr int kLeastPicture = 16;  // [px] smaller pictures have no regions

// Saliency of a picture that is scaled to `size`, divided by its mean.
cv::Mat saliencyOf(const cv::Mat& grey, const cv::Size& size) {
  cv::Mat small, saliency;
  cv::resize(grey, small, size, 0, 0, cv::INTER_AREA);
  const auto residual = cv::saliency::StaticSaliencySpectralResidual::create();
  residual->setImageWidth(size.width);
  residual->setImageHeight(size.height);
  residual->computeSaliency(small, saliency);
  const double mean = cv::mean(saliency)[0];
  if (!(mean > 0)) return {};
  saliency.convertTo(saliency, CV_32F, 1 / mean);
  return saliency;
}

class BoxList {
 public:
  BoxList(const SaliencyOptions& options, const cv::Size& picture) : options_(options), picture_(picture) {}

  /// Adds a box unless its size is not that of a sign, or a box of the list overlaps it by `same`. Returns whether it
  /// was added.
  bool add(const cv::Rect2f& box, double same) {
    if (box.width < static_cast<float>(options_.min_width) || box.height < static_cast<float>(options_.min_height) ||
        box.width > options_.max_share * picture_.width || box.height > options_.max_share * picture_.height)
      return false;
    for (const cv::Rect2f& other : boxes_) {
      if (overlapOf(box, other) >= same) return false;
    }
    boxes_.push_back(box);
    return true;
  }
  const std::vector<cv::Rect2f>& boxes() const { return boxes_; }

 private:
  const SaliencyOptions& options_;
  cv::Size picture_;
  std::vector<cv::Rect2f> boxes_;
};

void addComponents(const cv::Mat& saliency, double height, const cv::Size& picture, BoxList& boxes) {
  cv::Mat labels, statistics, middles;
  const int count = cv::connectedComponentsWithStats(saliency > height, labels, statistics, middles, 8, CV_32S);
  const float across = static_cast<float>(picture.width) / static_cast<float>(saliency.cols),
              down = static_cast<float>(picture.height) / static_cast<float>(saliency.rows);
  for (int i = 1; i < count; ++i) {
    const auto* box = statistics.ptr<int>(i);
    boxes.add({static_cast<float>(box[cv::CC_STAT_LEFT]) * across - 0.5f,
               static_cast<float>(box[cv::CC_STAT_TOP]) * down - 0.5f,
               static_cast<float>(box[cv::CC_STAT_WIDTH]) * across, static_cast<float>(box[cv::CC_STAT_HEIGHT]) * down},
              kSameBox);
  }
}

Corners cornersOf(const cv::Rect2f& box) {
  const float right = box.x + box.width, bottom = box.y + box.height;
  return {Eigen::Vector2f(box.x, box.y), Eigen::Vector2f(right, box.y), Eigen::Vector2f(right, bottom),
          Eigen::Vector2f(box.x, bottom)};
}

}  // namespace

std::vector<Corners> SaliencyProposer::propose(const camera::ColourImage& picture) const {
  const cv::Mat pixels = matOf(picture);
  if (std::min(pixels.cols, pixels.rows) < kLeastPicture) return {};
  const cv::Mat grey = greyOf(pixels, picture.order);
  BoxList components(options_, pixels.size());
  for (int scale = options_.scales - 1; scale >= 0; --scale) {
    const int width = options_.working_width >> scale, height = cvRound(1.0 * width * grey.rows / grey.cols);
    if (width < kLeastPicture || height < kLeastPicture / 2 || height > 4 * options_.working_width) continue;
    const cv::Mat saliency = saliencyOf(grey, {width, height});
    if (saliency.empty()) continue;
    for (int level = 0; level < options_.levels; ++level)
      addComponents(saliency, std::ldexp(options_.min_saliency, level), pixels.size(), components);
  }
  std::vector<Corners> regions;
  BoxList plates(options_, pixels.size());
  for (const cv::Rect2f& box : components.boxes()) {
    const auto corners = options_.fit_plates ? findPlate(pixels, box, options_.surroundings) : cornersOf(box);
    if (corners && plates.add(boundsOf(*corners), kSame)) regions.push_back(*corners);
  }
  return regions;
}

}  // namespace omnimapper::signs
