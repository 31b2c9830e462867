#pragma once

#include <mrpt/obs/CObservation3DRangeScan.h>
#include <omnimapper/base/OptionTable.h>
#include <omnimapper/camera/RgbdView.h>
#include <omnimapper/obs/CObservationPlanes.h>
#include <omnimapper/perception/Extractor.h>
#include <omnimapper/perception/PlaneSegmenter.h>

namespace omnimapper::perception {

struct OutlineOptions {
  /// [px] A corner of an outline that is nearer than this to the line through the remaining corners is left out. 0
  /// keeps all corners of pixels, which are some ten times as many.
  double tolerance = 1;

  static const base::OptionTable<OutlineOptions>& table();
};

/// How planes are found in depth images and described.
struct PlaneSettings {
  PlaneOptions planes;
  OutlineOptions outlines;
  PlaneComparisonOptions comparison = {};

  bool operator==(const PlaneSettings& other) const {
    return planes == other.planes && outlines.tolerance == other.outlines.tolerance && comparison == other.comparison;
  }
};

/// The label of a scan's planes is the scan's label with this suffix.
inline constexpr char kPlanesSuffix[] = ".planes";

/// Extracts the planes of a range camera's depth image (thesis 3.4), as PlaneSegmenter finds them.
class PlaneExtractor : public Extractor {
 public:
  static constexpr const char* kName = "PlaneExtractor";
  static constexpr const char* kSummary = "Planes of depth images with outlines and covariance.";

  /// Throws Error(out_of_range) for min_depth >= max_depth.
  PlaneExtractor(const PlaneOptions& planes, const OutlineOptions& outlines,
                 const PlaneComparisonOptions& comparison = {})
      : settings_{planes, outlines, comparison}, segmenter_(planes, comparison) {}

  /// The planes of a scan, in the frame of its sensorPose (x forward, y left, z up). They have the scan's stamp and
  /// sensorPose, and the label "<scan label>.planes". Their colours come from the scan's picture; if the picture has
  /// another view than the depth image, the calibrations of both cameras relate their pixels. Depths of 0 or 65535
  /// units are no measurements; lens distortion is not removed. A scan without depths has no planes. Throws
  /// Error(unreadable_input) for a camera whose focal length is unknown, and if the comparison needs colours and the
  /// scan has none. Throws Error(missing_images) for images in files that were not loaded (sources load such files).
  /// Thread-safe; the same scan gives the same bits.
  std::shared_ptr<obs::CObservationPlanes> extract(const mrpt::obs::CObservation3DRangeScan& scan) const;

  bool wants(const mrpt::obs::CObservation& raw) const override;
  std::vector<mrpt::obs::CObservation::Ptr> extract(const mrpt::obs::CObservation& raw) const override;
  /// Nothing if another extractor has found planes with the same settings.
  std::vector<mrpt::obs::CObservation::Ptr> extractUsing(const mrpt::obs::CObservation& raw,
                                                         Blackboard& board) const override;
  std::vector<DerivedName> namesOf(const mrpt::obs::CObservation& raw) const override;

 private:
  PlaneSegmentation planesIn(const mrpt::obs::CObservation3DRangeScan& scan, const camera::RgbdView& view) const;

  PlaneSettings settings_;
  PlaneSegmenter segmenter_;
};

}  // namespace omnimapper::perception
