#include "SalientSignDetector.h"

#include <algorithm>
#include <utility>

#include "Plate.h"

namespace omnimapper::signs {

namespace {

// Two regions are of one sign if they share more than this part of the smaller one.
constexpr double kCovered = 0.5;

bool areOnOneAnother(const cv::Rect2f& a, const cv::Rect2f& b) {
  return (a & b).area() > kCovered * std::min(a.area(), b.area());
}

}  // namespace

SalientSignDetector::SalientSignDetector(const SalientSignOptions& options)
    : SalientSignDetector(options,
                          options.model.empty() ? SignClassifier::known() : SignClassifier::read(options.model)) {}

SalientSignDetector::SalientSignDetector(const SalientSignOptions& options, SignClassifier classifier)
    : options_(options), proposer_(options.saliency), classifier_(std::move(classifier)) {}

std::vector<SignRegion> SalientSignDetector::detect(const camera::ColourImage& picture) const {
  const std::vector<Corners> regions = proposer_.propose(picture);
  const std::vector<double> scores = classifier_.probabilities(picture, regions);
  std::vector<SignRegion> signs;
  for (std::size_t i = 0; i < regions.size(); ++i) {
    if (scores[i] >= options_.min_score) signs.push_back({regions[i], scores[i]});
  }
  std::stable_sort(signs.begin(), signs.end(), [](const auto& a, const auto& b) { return a.score > b.score; });
  std::vector<SignRegion> kept;
  for (const SignRegion& sign : signs) {
    const bool is_new = std::none_of(kept.begin(), kept.end(), [&](const SignRegion& other) {
      return areOnOneAnother(boundsOf(sign.corners_px), boundsOf(other.corners_px));
    });
    if (is_new) kept.push_back(sign);
  }
  return kept;
}

}  // namespace omnimapper::signs

extern "C" omnimapper::signs::SignDetector* omnimapperSalientSignDetector(const std::string& model, double min_score) {
  omnimapper::signs::SalientSignOptions options;
  options.model = model;
  options.min_score = min_score;
  return new omnimapper::signs::SalientSignDetector(options);
}
