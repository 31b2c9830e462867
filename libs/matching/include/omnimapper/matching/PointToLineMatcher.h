#pragma once

#include <mrpt/slam/CMetricMapsAlignmentAlgorithm.h>
#include <omnimapper/matching/ScanMatcher.h>
#include <omnimapper/matching/ScanMatcherOptions.h>

namespace omnimapper::matching {

/// Moves a scan until its points lie on the lines of a reference (Chen and Medioni 1991; Censi 2008), by Gauss-Newton
/// with a redescending weight whose scale shrinks to what the match is good for. Directions that the lines do not fix
/// are left alone in each step (Zhang, Kaess and Singh 2016) and said to be open.
class PointToLineMatcher : public ScanMatcher, public mrpt::slam::CMetricMapsAlignmentAlgorithm {
 public:
  explicit PointToLineMatcher(const ScanMatcherOptions& options) : options_(options) {}

  std::shared_ptr<const MatchReference> prepare(ScanWithNormals reference) const override;
  ScanMatch match(const MatchReference& reference, const ScanWithNormals& scan, const MatchGuess& guess) const override;
  /// The match of a pose as it stands, without moving it.
  static ScanMatch judge(const MatchReference& reference, const ScanWithNormals& scan, const mrpt::math::TPose2D& pose);

  /// MRPT's interface: both maps are mrpt::maps::CPointsMap, points in the order of the beams; what is told is the pose
  /// of `m2` in `m1`. Throws base::Error for maps of other kinds.
  mrpt::poses::CPosePDF::Ptr AlignPDF(
      const mrpt::maps::CMetricMap* m1, const mrpt::maps::CMetricMap* m2,
      const mrpt::poses::CPosePDFGaussian& initialEstimationPDF,
      mrpt::optional_ref<mrpt::slam::TMetricMapAlignmentResult> outInfo = std::nullopt) override;
  /// In the plane only: throws base::Error.
  mrpt::poses::CPose3DPDF::Ptr Align3DPDF(
      const mrpt::maps::CMetricMap* m1, const mrpt::maps::CMetricMap* m2,
      const mrpt::poses::CPose3DPDFGaussian& initialEstimationPDF,
      mrpt::optional_ref<mrpt::slam::TMetricMapAlignmentResult> outInfo = std::nullopt) override;

 private:
  ScanMatcherOptions options_;
};

}  // namespace omnimapper::matching
