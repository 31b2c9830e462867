#pragma once

#include <omnimapper/signs/SaliencyProposer.h>
#include <omnimapper/signs/SignClassifier.h>

namespace omnimapper::signs {

struct SalientSignOptions {
  double min_score = 0.6;  ///< of a region that is reported
  std::string model;       ///< file of SignClassifier; empty: the one that is shipped
  SaliencyOptions saliency;
};

/// The thesis's way to find door signs: what is salient (3.5.1.1), told by a support vector machine (3.5.3). Of regions
/// that lie on one another the one with the best score is kept.
class SalientSignDetector : public SignDetector {
 public:
  /// Throws as SignClassifier::read().
  explicit SalientSignDetector(const SalientSignOptions& options);
  SalientSignDetector(const SalientSignOptions& options, SignClassifier classifier);

  std::vector<SignRegion> detect(const perception::ColourImage& picture) const override;

 private:
  SalientSignOptions options_;
  SaliencyProposer proposer_;
  SignClassifier classifier_;
};

}  // namespace omnimapper::signs
