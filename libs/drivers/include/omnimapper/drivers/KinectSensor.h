#pragma once

#include <mrpt/hwdrivers/CGenericSensor.h>
#include <omnimapper/drivers/KinectOptions.h>

#include <memory>

namespace omnimapper::drivers {

struct FreenectMessage;

/// A driver in MRPT's sense of a Kinect of the first generation, through libfreenect, which Debian's MRPT is built
/// without. It gives CObservation3DRangeScan with its sensorLabel (KINECT by default), and CObservationIMU that have
/// only accelerations, with this label and the suffix _IMU: [m/s^2], x forward, y left, z up in the orientation of the
/// depth camera, 9.8 upwards at rest, none before the first depth image. Stamps are of the host's clock, but their
/// differences are those of the device's clock. The keys of its section are KinectOptions.
class KinectSensor : public mrpt::hwdrivers::CGenericSensor {
  DEFINE_GENERIC_SENSOR(KinectSensor)
 public:
  KinectSensor();
  ~KinectSensor() override;

  /// Throws base::Error(unreadable_input) if there is no Kinect or it does not start.
  void initialize() override;
  /// Returns after the next depth image, or a tenth of a second. Throws base::Error(unreadable_input) if the Kinect is
  /// lost or its depth camera silent.
  void doProcess() override;

 protected:
  /// Throws base::Error as KinectOptions::read().
  void loadConfig_sensorSpecific(const mrpt::config::CConfigFileBase& ini, const std::string& section) override;

 private:
  struct Open;
  void add(FreenectMessage& message);
  bool handOut();

  KinectOptions options_;
  std::unique_ptr<Open> open_;
};

}  // namespace omnimapper::drivers
