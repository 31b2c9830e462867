#pragma once

#include <omnimapper/sim/Sensor.h>

#include "../camera/ObjectsInFrame.h"
#include "../camera/Shader.h"
#include "RgbdOptions.h"

namespace omnimapper::sim {

/// A camera of depth and colour: mrpt::obs::CObservation3DRangeScan. The pose in the INI is that of the depth camera,
/// which looks along x. The observation's sensorPose is the same, or that of the colour camera if depth is registered.
/// Truth: k, stamp, time_s, picture_time_s, map_from_sensor of the range image, and faces in the picture
/// (facesInView()); images in labels/ and depth/ with the same pixels as the range image.
class RgbdCamera : public Sensor {
 public:
  RgbdCamera(const RgbdOptions& options, const SensorOptions& mount, const SensorContext& context);
  Measurement measure(int k) const override;
  std::optional<CameraView> pictureView(int k) const override;
  bool isCamera() const override { return true; }
  std::size_t sizeOfMeasurement() const override;

 private:
  struct Pictures;
  geometry::Se3 mapFromColour(double time) const;
  Pictures cast(double time) const;
  /// Depths that the depth camera measures.
  std::vector<float> sense(const Pictures& pictures, int k) const;
  bool isInRange(float depth) const;
  std::vector<VisiblePoint> seenPoints(const Frame& frame, const std::vector<float>& depths) const;
  void fillDepth(const std::vector<float>& depths, mrpt::obs::CObservation& observation) const;
  void fillColour(const Pictures& pictures, int k, mrpt::obs::CObservation& observation) const;

  RgbdOptions options_of_camera_;
  RgbdSettings settings_;
  Shader shader_;
  ObjectsInFrame objects_;
  geometry::Se3 sensor_from_colour_;  // both look along x
  /// From the depth camera's optical frame to the colour camera's.
  Eigen::Vector3d depthToColour() const { return {-settings_.colour_right, 0, 0}; }
  /// Whether depths are measured in the depth camera's view and then registered to the colour camera's.
  bool isRegistered() const { return hands_out_colour_view_ && !settings_.exact; }
  bool hands_out_colour_view_;  // the range image has the view of the colour camera
};

}  // namespace omnimapper::sim
