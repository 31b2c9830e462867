#include "SignClassifier.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "FeatureScale.h"

namespace omnimapper::signs {

namespace {

bool isValid(const HogOptions& hog) {
  const auto in = [](int value, int low, int high) { return value >= low && value <= high; };
  return in(hog.columns, 1, 16) && in(hog.rows, 1, 16) && in(hog.cell, 2, 32) &&
         in(hog.block, 1, std::min(hog.columns, hog.rows)) && in(hog.orientations, 2, 36) && hog.margin >= 0 &&
         hog.margin <= 0.4;
}

bool isValid(const SignModel& model) {
  if (!isValid(model.hog) || model.vectors.empty() || model.vectors.size() != model.weights.size()) return false;
  for (const double value : {model.gamma, model.bias, model.slope, model.offset}) {
    if (!std::isfinite(value)) return false;
  }
  const auto length = static_cast<std::size_t>(model.hog.length());
  return model.gamma > 0 &&
         std::all_of(model.weights.begin(), model.weights.end(), [](double weight) { return std::isfinite(weight); }) &&
         std::all_of(model.vectors.begin(), model.vectors.end(),
                     [&](const SignFeatures& vector) { return vector.size() == length; });
}

int squaredDistance(const std::uint8_t* a, const std::uint8_t* b, std::size_t length) {
  int sum = 0;
  for (std::size_t i = 0; i < length; ++i) {
    const int difference = static_cast<int>(a[i]) - static_cast<int>(b[i]);
    sum += difference * difference;
  }
  return sum;
}

}  // namespace

SignClassifier::SignClassifier(SignModel model) : model_(std::move(model)) {
  if (!isValid(model_)) throw std::invalid_argument("a model of door signs whose parts do not fit one another");
}

double SignClassifier::decision(const SignFeatures& features) const {
  if (features.size() != static_cast<std::size_t>(model_.hog.length()))
    throw std::invalid_argument("features of another length than the model's");
  const double scale = -model_.gamma / (static_cast<double>(kFeatureScale) * kFeatureScale);
  double sum = model_.bias;
  for (std::size_t i = 0; i < model_.vectors.size(); ++i)
    sum += model_.weights[i] *
           std::exp(scale * squaredDistance(features.data(), model_.vectors[i].data(), features.size()));
  return sum;
}

double SignClassifier::probability(const SignFeatures& features) const {
  return 1 / (1 + std::exp(model_.slope * decision(features) + model_.offset));
}

std::vector<double> SignClassifier::probabilities(const camera::ColourImage& picture,
                                                  const std::vector<Corners>& regions) const {
  std::vector<double> probabilities;
  for (const SignFeatures& features : describe(picture, regions, model_.hog))
    probabilities.push_back(probability(features));
  return probabilities;
}

}  // namespace omnimapper::signs
