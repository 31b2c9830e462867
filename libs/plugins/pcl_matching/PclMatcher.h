#pragma once

#include <omnimapper/matching/CloudMatcher.h>

#include <optional>

namespace omnimapper::pcl_matching {

/// Registration of clouds by PCL (its ICP, ICP with normals and GICP) with the limits of our own matcher. Our matcher
/// then judges the result and computes the uncertainty of the match from its residuals.
class PclMatcher : public matching::CloudMatcher {
 public:
  explicit PclMatcher(const matching::CloudMatcherOptions& options) : options_(options), judge_(options) {}

  matching::CloudMatch match(const matching::MatchCloud& target, const matching::MatchCloud& source,
                             const geometry::Se3& guess) const override;

 private:
  std::optional<geometry::Se3> registered(const matching::MatchCloud& target, const matching::MatchCloud& source,
                                          const geometry::Se3& guess) const;

  matching::CloudMatcherOptions options_;
  matching::IteratedClosestPoints judge_;
};

}  // namespace omnimapper::pcl_matching
