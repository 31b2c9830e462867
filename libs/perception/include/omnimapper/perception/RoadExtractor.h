#pragma once

#include <mrpt/obs/CObservation3DRangeScan.h>
#include <omnimapper/obs/CObservationPlanes.h>
#include <omnimapper/perception/Extractor.h>
#include <omnimapper/perception/PlaneExtractor.h>
#include <omnimapper/perception/RoadSegmenter.h>

namespace omnimapper::perception {

struct RoadPoseOptions {
  double ground_height = 0;  ///< [m] height of the ground in the base's frame

  static const base::OptionTable<RoadPoseOptions>& table();
};

/// The label of a scan's ground is the scan's label with this suffix.
inline constexpr char kRoadSuffix[] = ".road";

/// The ground that the wheels stand on, as a plane in the camera's optical frame. In the base's frame it is the level
/// plane at the height `ground_height` [m]; the scan's sensorPose relates the two frames.
geometry::Plane3 expectedGround(const mrpt::obs::CObservation3DRangeScan& scan, double ground_height);

/// Extracts the ground that a depth camera sees, as RoadSegmenter finds it (thesis 3.4.7).
class RoadExtractor : public Extractor {
 public:
  static constexpr const char* kName = "RoadExtractor";
  static constexpr const char* kSummary =
      "Finds the ground in depth images, also where it slopes, near the ground that the camera's pose predicts.";

  /// Throws as RoadSegmenter.
  RoadExtractor(const RoadOptions& road, const OutlineOptions& outlines, const RoadPoseOptions& pose)
      : segmenter_(road), outlines_(outlines), pose_(pose) {}

  /// The pieces of ground, each with the plane that fits it best. They have the form of the planes of PlaneExtractor,
  /// and the label "<scan label>.road". Throws as PlaneExtractor. Thread-safe; the same scan gives the same bits.
  std::shared_ptr<obs::CObservationPlanes> extract(const mrpt::obs::CObservation3DRangeScan& scan) const;

  bool wants(const mrpt::obs::CObservation& raw) const override;
  std::vector<mrpt::obs::CObservation::Ptr> extract(const mrpt::obs::CObservation& raw) const override;
  std::vector<mrpt::obs::CObservation::Ptr> extractUsing(const mrpt::obs::CObservation& raw,
                                                         Blackboard& board) const override;
  std::vector<DerivedName> namesOf(const mrpt::obs::CObservation& raw) const override;

 private:
  std::shared_ptr<obs::CObservationPlanes> groundIn(const mrpt::obs::CObservation3DRangeScan& scan,
                                                    const camera::RgbdView& view) const;

  RoadSegmenter segmenter_;
  OutlineOptions outlines_;
  RoadPoseOptions pose_;
};

}  // namespace omnimapper::perception
