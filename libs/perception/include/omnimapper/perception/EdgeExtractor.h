#pragma once

#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/obs/CObservationPointCloud.h>
#include <omnimapper/camera/RgbdView.h>
#include <omnimapper/perception/EdgeDetector.h>
#include <omnimapper/perception/Extractor.h>

#include <string>
#include <vector>

namespace omnimapper::perception {

/// The label of a scan's edges is the scan's label, this suffix, and the name of the kind of edges.
inline constexpr char kEdgesSuffix[] = ".edges.";

/// Extracts the 3D edges of a range camera's depth image and picture (thesis 3.1), as EdgeDetector finds them.
class EdgeExtractor : public Extractor {
 public:
  static constexpr const char* kName = "EdgeExtractor";
  static constexpr const char* kSummary =
      "Finds edges in depth images and their pictures, and makes a cloud of 3D points for each kind of edge.";

  /// Throws as EdgeDetector.
  explicit EdgeExtractor(const EdgeOptions& options) : options_(options), detector_(options) {}

  /// One cloud for each kind of edges that the options ask for; RGB edges only if the scan has a picture. A cloud has
  /// the scan's stamp and sensorPose, points [m] in the frame of this pose (x forward, y left, z up), and the label
  /// "<scan label>.edges.<nameOf(kind)>". If the picture has another view than the depth image, RGB edges are those
  /// depth pixels at which the picture shows an edge according to the calibrations of the two cameras. Throws
  /// Error(unreadable_input) for a camera whose focal length is unknown, and Error(missing_images) for images in files
  /// that were not loaded (sources load such files). Thread-safe; the same scan gives the same bits.
  std::vector<mrpt::obs::CObservationPointCloud::Ptr> extract(const mrpt::obs::CObservation3DRangeScan& scan) const;
  /// Labels of the clouds that extract() makes of the scan. Throws Error(missing_images) if the scan's picture is in a
  /// file that was not loaded.
  std::vector<std::string> labelsOf(const mrpt::obs::CObservation3DRangeScan& scan) const;

  bool wants(const mrpt::obs::CObservation& raw) const override;
  std::vector<mrpt::obs::CObservation::Ptr> extract(const mrpt::obs::CObservation& raw) const override;
  std::vector<mrpt::obs::CObservation::Ptr> extractUsing(const mrpt::obs::CObservation& raw,
                                                         Blackboard& board) const override;
  std::vector<DerivedName> namesOf(const mrpt::obs::CObservation& raw) const override;

 private:
  std::vector<mrpt::obs::CObservationPointCloud::Ptr> cloudsOf(const mrpt::obs::CObservation3DRangeScan& scan,
                                                               const camera::RgbdView& view) const;

  EdgeOptions options_;
  EdgeDetector detector_;
};

}  // namespace omnimapper::perception
