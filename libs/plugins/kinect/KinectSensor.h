#pragma once

#include <mrpt/hwdrivers/CGenericSensor.h>
#include <omnimapper/drivers/KinectOptions.h>

#include <memory>

namespace omnimapper::drivers {

struct FreenectMessage;

/// An MRPT driver of a Kinect of the first generation. It uses libfreenect itself, because Debian's MRPT is built
/// without it. It gives CObservation3DRangeScan with its sensorLabel (KINECT by default), and CObservationIMU with this
/// label and the suffix _IMU. The latter have only accelerations: [m/s^2], x forward, y left, z up in the orientation
/// of the depth camera, 9.8 upwards at rest. No accelerations are given before the first depth image. Stamps are of the
/// host's clock; the differences between stamps of depth images are measured by the device's clock, and accelerations
/// are stamped on arrival. KinectOptions are the keys of the driver's section.
class KinectSensor : public mrpt::hwdrivers::CGenericSensor {
  DEFINE_GENERIC_SENSOR(KinectSensor)
 public:
  KinectSensor();
  ~KinectSensor() override;

  /// Throws base::Error(unreadable_input) if there is no Kinect or it does not start.
  void initialize() override;
  /// Returns after the next depth image, or after a tenth of a second. Throws base::Error(unreadable_input) if the
  /// Kinect is lost or its depth camera is silent.
  void doProcess() override;

 protected:
  /// Throws base::Error as KinectOptions::read() does.
  void loadConfig_sensorSpecific(const mrpt::config::CConfigFileBase& ini, const std::string& section) override;

 private:
  struct Open;
  void add(FreenectMessage& message);
  bool handOut();

  KinectOptions options_;
  std::unique_ptr<Open> open_;
};

}  // namespace omnimapper::drivers
