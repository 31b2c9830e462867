#pragma once

#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/obs/CObservationPointCloud.h>
#include <omnimapper/perception/EdgeDetector.h>
#include <omnimapper/perception/Extractor.h>

#include <string>
#include <vector>

namespace omnimapper::perception {

/// What the label of a scan's edges has behind the scan's own, before the name of their kind.
inline constexpr char kEdgesSuffix[] = ".edges.";

/// The 3D edges that a range camera's depth image and picture show (thesis 3.1), as EdgeDetector finds them.
class EdgeExtractor : public Extractor {
 public:
  static constexpr const char* kName = "EdgeExtractor";
  static constexpr const char* kSummary =
      "3D edges of depth images and their pictures, a cloud of points for each kind.";

  /// Throws as EdgeDetector.
  explicit EdgeExtractor(const EdgeOptions& options) : options_(options), detector_(options) {}

  /// A cloud for each kind that the options want, RGB only of scans with a picture: stamp and sensorPose of the scan,
  /// points [m] in the frame of that pose (x forward, y left, z up), label "<scan label>.edges.<nameOf(kind)>". Where
  /// the picture is not of the depth image's view, its edges are those depth pixels that it sees an edge at, by the two
  /// cameras' calibrations. Throws Error(unreadable_input) for a camera whose focal length is unknown and
  /// Error(missing_images) for images that are in files and were not loaded; sources load them. Thread-safe; the same
  /// scan gives the same bits.
  std::vector<mrpt::obs::CObservationPointCloud::Ptr> extract(const mrpt::obs::CObservation3DRangeScan& scan) const;
  /// Of the clouds that extract() makes of the scan. Throws where its picture was not loaded.
  std::vector<std::string> labelsOf(const mrpt::obs::CObservation3DRangeScan& scan) const;

  bool wants(const mrpt::obs::CObservation& raw) const override;
  std::vector<mrpt::obs::CObservation::Ptr> extract(const mrpt::obs::CObservation& raw) const override;
  std::vector<DerivedName> namesOf(const mrpt::obs::CObservation& raw) const override;

 private:
  EdgeOptions options_;
  EdgeDetector detector_;
};

}  // namespace omnimapper::perception
