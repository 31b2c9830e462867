#pragma once

#include "SaliencyProposer.h"
#include "SignClassifier.h"

namespace omnimapper::signs {

struct SalientSignOptions {
  double min_score = 0.6;  ///< smallest score of a region that is reported
  std::string model;       ///< file of the SignClassifier; empty: the shipped one
  SaliencyOptions saliency;
};

/// Finds door signs as the thesis does: a support vector machine (3.5.3) classifies salient regions (3.5.1.1). Of
/// regions that overlap, the one with the best score is kept.
class SalientSignDetector : public SignDetector {
 public:
  /// Throws as SignClassifier::read().
  explicit SalientSignDetector(const SalientSignOptions& options);
  SalientSignDetector(const SalientSignOptions& options, SignClassifier classifier);

  std::vector<SignRegion> detect(const camera::ColourImage& picture) const override;

 private:
  SalientSignOptions options_;
  SaliencyProposer proposer_;
  SignClassifier classifier_;
};

}  // namespace omnimapper::signs
