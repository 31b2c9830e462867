#pragma once

#include <mrpt/obs/CObservation3DRangeScan.h>
#include <omnimapper/base/OptionTable.h>
#include <omnimapper/obs/CObservationPlanes.h>
#include <omnimapper/perception/Extractor.h>
#include <omnimapper/perception/PlaneSegmenter.h>

namespace omnimapper::perception {

struct OutlineOptions {
  /// [px]; corners of an outline that lie closer to the line through the others are left out. 0 keeps every corner of
  /// every pixel, some ten times as many.
  double tolerance = 1;

  static const base::OptionTable<OutlineOptions>& table();
};

/// Suffix of the label of a scan's planes, after the scan's label.
inline constexpr char kPlanesSuffix[] = ".planes";

/// Extracts the planes of a range camera's depth image (thesis 3.4), as PlaneSegmenter finds them.
class PlaneExtractor : public Extractor {
 public:
  static constexpr const char* kName = "PlaneExtractor";
  static constexpr const char* kSummary = "Planes of depth images with outlines and covariance.";

  /// Throws Error(out_of_range) for min_depth >= max_depth.
  PlaneExtractor(const PlaneOptions& planes, const OutlineOptions& outlines,
                 const PlaneComparisonOptions& comparison = {})
      : segmenter_(planes, comparison), outlines_(outlines) {}

  /// Planes with the scan's stamp and sensorPose, in the frame of that pose (x forward, y left, z up), label
  /// "<scan label>.planes". Colours are those of the scan's picture, mapped by the calibrations of both
  /// cameras if the picture has another view than the depth image. Depths of 0 or 65535 units are no measurements; lens
  /// distortion is not removed. A scan without depths has no planes. Throws Error(unreadable_input) for a camera whose
  /// focal length is unknown, or where a comparison needs colours and the scan has none, and Error(missing_images) for
  /// images that are in files and were not loaded; sources load them. Thread-safe; the same scan gives the same bits.
  std::shared_ptr<obs::CObservationPlanes> extract(const mrpt::obs::CObservation3DRangeScan& scan) const;

  bool wants(const mrpt::obs::CObservation& raw) const override;
  std::vector<mrpt::obs::CObservation::Ptr> extract(const mrpt::obs::CObservation& raw) const override;
  std::vector<DerivedName> namesOf(const mrpt::obs::CObservation& raw) const override;

 private:
  PlaneSegmenter segmenter_;
  OutlineOptions outlines_;
};

}  // namespace omnimapper::perception
