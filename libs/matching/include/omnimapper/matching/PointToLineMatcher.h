#pragma once

#include <mrpt/slam/CMetricMapsAlignmentAlgorithm.h>
#include <omnimapper/matching/ScanMatcher.h>
#include <omnimapper/matching/ScanMatcherOptions.h>

namespace omnimapper::matching {

/// Moves a scan until its points lie on the lines of a reference (Chen and Medioni 1991; Censi 2008), by Gauss-Newton
/// with weights that decrease with a point's distance from its line, on a scale that shrinks to the precision of the
/// match. In directions that the lines do not constrain, the lines do not move the scan (Zhang, Kaess and Singh 2016);
/// such directions are reported as open.
class PointToLineMatcher : public ScanMatcher, public mrpt::slam::CMetricMapsAlignmentAlgorithm {
 public:
  explicit PointToLineMatcher(const ScanMatcherOptions& options) : options_(options) {}

  std::shared_ptr<const MatchReference> prepare(ScanWithNormals reference) const override;
  ScanMatch match(const MatchReference& reference, const ScanWithNormals& scan, const MatchGuess& guess) const override;
  /// Evaluates the match at `pose` without moving the scan.
  static ScanMatch judge(const MatchReference& reference, const ScanWithNormals& scan, const mrpt::math::TPose2D& pose);

  /// MRPT's interface: both maps are mrpt::maps::CPointsMap, points in the order of the beams; the result is the pose
  /// of `m2` in `m1`. Throws base::Error for maps of other kinds.
  mrpt::poses::CPosePDF::Ptr AlignPDF(
      const mrpt::maps::CMetricMap* m1, const mrpt::maps::CMetricMap* m2,
      const mrpt::poses::CPosePDFGaussian& initialEstimationPDF,
      mrpt::optional_ref<mrpt::slam::TMetricMapAlignmentResult> outInfo = std::nullopt) override;
  /// Throws base::Error: maps are aligned in the plane only.
  mrpt::poses::CPose3DPDF::Ptr Align3DPDF(
      const mrpt::maps::CMetricMap* m1, const mrpt::maps::CMetricMap* m2,
      const mrpt::poses::CPose3DPDFGaussian& initialEstimationPDF,
      mrpt::optional_ref<mrpt::slam::TMetricMapAlignmentResult> outInfo = std::nullopt) override;

 private:
  ScanMatcherOptions options_;
};

}  // namespace omnimapper::matching
