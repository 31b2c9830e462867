#pragma once

#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/obs/CObservationPointCloud.h>
#include <omnimapper/perception/EdgeDetector.h>
#include <omnimapper/perception/Extractor.h>

#include <string>
#include <vector>

namespace omnimapper::perception {

/// Suffix of the labels of a scan's edges, after the scan's label and before the name of the kind of edges.
inline constexpr char kEdgesSuffix[] = ".edges.";

/// Extracts the 3D edges of a range camera's depth image and picture (thesis 3.1), as EdgeDetector finds them.
class EdgeExtractor : public Extractor {
 public:
  static constexpr const char* kName = "EdgeExtractor";
  static constexpr const char* kSummary =
      "3D edges of depth images and their pictures, a cloud of points for each kind.";

  /// Throws as EdgeDetector.
  explicit EdgeExtractor(const EdgeOptions& options) : options_(options), detector_(options) {}

  /// One cloud for each kind that the options want, RGB only for scans with a picture: stamp and sensorPose of the
  /// scan, points [m] in the frame of that pose (x forward, y left, z up), label "<scan label>.edges.<nameOf(kind)>".
  /// If the picture has another view than the depth image, RGB edges are the depth pixels at which the picture shows an
  /// edge, by the two cameras' calibrations. Throws Error(unreadable_input) for a camera whose focal length is unknown
  /// and Error(missing_images) for images that are in files and were not loaded; sources load them. Thread-safe; the
  /// same scan gives the same bits.
  std::vector<mrpt::obs::CObservationPointCloud::Ptr> extract(const mrpt::obs::CObservation3DRangeScan& scan) const;
  /// Labels of the clouds that extract() makes of the scan. Throws if its picture was not loaded.
  std::vector<std::string> labelsOf(const mrpt::obs::CObservation3DRangeScan& scan) const;

  bool wants(const mrpt::obs::CObservation& raw) const override;
  std::vector<mrpt::obs::CObservation::Ptr> extract(const mrpt::obs::CObservation& raw) const override;
  std::vector<DerivedName> namesOf(const mrpt::obs::CObservation& raw) const override;

 private:
  EdgeOptions options_;
  EdgeDetector detector_;
};

}  // namespace omnimapper::perception
