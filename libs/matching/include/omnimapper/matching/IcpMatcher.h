#pragma once

#include <omnimapper/matching/ScanMatcher.h>
#include <omnimapper/matching/ScanMatcherOptions.h>

namespace omnimapper::matching {

/// MRPT's iterative closest point (mrpt::slam::CICP; Besl and McKay 1992), then PointToLineMatcher from the pose that
/// ICP found. The guess is only where the search begins; its information is ignored.
class IcpMatcher : public ScanMatcher {
 public:
  explicit IcpMatcher(const ScanMatcherOptions& options) : options_(options) {}

  std::shared_ptr<const MatchReference> prepare(ScanWithNormals reference) const override;
  ScanMatch match(const MatchReference& reference, const ScanWithNormals& scan, const MatchGuess& guess) const override;

 private:
  ScanMatcherOptions options_;
};

}  // namespace omnimapper::matching
