#include "Machine.h"

#include <omnimapper/base/Error.h>
#include <omnimapper/base/SplitMix.h>

#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/ml.hpp>

#include "FeatureScale.h"
#include "PlattScaling.h"

namespace omnimapper::signs {

namespace {

constexpr int kMostSteps = 20000;
constexpr double kAccuracy = 1e-4;

// OpenCV's machine takes the lower label as the positive class.
enum Label : int { kSign = 0, kOther = 1 };

bool holdsBoth(const std::vector<const LabelledRegion*>& regions) {
  bool sign = false, other = false;
  for (const LabelledRegion* region : regions) (region->is_sign ? sign : other) = true;
  return sign && other;
}

}  // namespace

SignModel trainMachine(const std::vector<const LabelledRegion*>& regions, const SignTrainingOptions& options) {
  const int length = options.hog.length(), count = static_cast<int>(regions.size());
  cv::Mat features(count, length, CV_32F), labels(count, 1, CV_32S);
  for (int row = 0; row < count; ++row) {
    const LabelledRegion& region = *regions[static_cast<std::size_t>(row)];
    for (int i = 0; i < length; ++i)
      features.at<float>(row, i) = static_cast<float>(region.features[static_cast<std::size_t>(i)]) / kFeatureScale;
    labels.at<int>(row) = region.is_sign ? kSign : kOther;
  }
  const auto machine = cv::ml::SVM::create();
  machine->setType(cv::ml::SVM::C_SVC);
  machine->setKernel(cv::ml::SVM::RBF);
  machine->setC(options.cost);
  machine->setGamma(options.gamma);
  machine->setTermCriteria({cv::TermCriteria::MAX_ITER + cv::TermCriteria::EPS, kMostSteps, kAccuracy});
  machine->train(features, cv::ml::ROW_SAMPLE, labels);

  SignModel model;
  model.hog = options.hog;
  model.gamma = options.gamma;
  cv::Mat weights, indices;
  model.bias = -machine->getDecisionFunction(0, weights, indices);
  const cv::Mat vectors = machine->getSupportVectors();
  for (int i = 0; i < static_cast<int>(indices.total()); ++i) {
    model.weights.push_back(weights.at<double>(i));
    SignFeatures vector;
    for (int j = 0; j < length; ++j)
      vector.push_back(
          static_cast<std::uint8_t>(std::lround(vectors.at<float>(indices.at<int>(i), j) * kFeatureScale)));
    model.vectors.push_back(std::move(vector));
  }
  return model;
}

int foldOf(const LabelledRegion& region, const SignTrainingOptions& options, FoldsOf what) {
  std::uint64_t hash = 0xcbf29ce484222325ULL;  // FNV-1a
  for (const char c : region.group) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3ULL;
  hash += 2 * static_cast<std::uint64_t>(options.seed) + (what == FoldsOf::trial ? 0 : 1);
  // The generator distributes the folds evenly even if names and seeds are similar.
  return base::SplitMix(hash).below(options.folds);
}

SignClassifier trainOn(const std::vector<const LabelledRegion*>& regions, const SignTrainingOptions& options) {
  std::vector<double> of_signs, of_others;
  for (int fold = 0; fold < options.folds; ++fold) {
    std::vector<const LabelledRegion*> learnt, tried;
    for (const LabelledRegion* region : regions)
      (foldOf(*region, options, FoldsOf::calibration) == fold ? tried : learnt).push_back(region);
    if (tried.empty() || !holdsBoth(learnt)) continue;
    const SignClassifier machine(trainMachine(learnt, options));
    for (const LabelledRegion* region : tried)
      (region->is_sign ? of_signs : of_others).push_back(machine.decision(region->features));
  }
  if (of_signs.empty() || of_others.empty()) {
    throw base::Error(
        base::ExitCode::unreadable_input,
        "there are too few training pictures: signs and regions without a sign are needed in at least two folds; "
        "take more pictures");
  }
  SignModel model = trainMachine(regions, options);
  const PlattScaling scaling = fitPlatt(of_signs, of_others);
  model.slope = scaling.slope;
  model.offset = scaling.offset;
  return SignClassifier(std::move(model));
}

}  // namespace omnimapper::signs
