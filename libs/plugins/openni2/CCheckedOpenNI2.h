#pragma once

#include <mrpt/hwdrivers/COpenNI2Sensor.h>

#include <memory>

namespace omnimapper::drivers {

/// Wraps COpenNI2Sensor, MRPT's driver of an Xtion or another camera of OpenNI2, with all its keys. It adds two checks:
/// whether there is a camera, because without one MRPT's driver ends the program, and whether the camera is still
/// plugged in, because otherwise MRPT's driver waits forever for the next frame.
class CCheckedOpenNI2 : public mrpt::hwdrivers::CGenericSensor {
  DEFINE_GENERIC_SENSOR(CCheckedOpenNI2)
 public:
  CCheckedOpenNI2();
  ~CCheckedOpenNI2() override;

  /// Throws base::Error(unreadable_input) if there is no camera, and what MRPT's driver throws if that driver cannot
  /// open the camera.
  void initialize() override;
  /// Returns after the next frame of all the camera's streams, or after a tenth of a second. Throws
  /// base::Error(unreadable_input) if the camera is gone.
  void doProcess() override;

 protected:
  void loadConfig_sensorSpecific(const mrpt::config::CConfigFileBase& ini, const std::string& section) override;

 private:
  class Driver;
  class Watch;

  std::unique_ptr<mrpt::config::CConfigFileBase> ini_;
  std::string section_;
  std::unique_ptr<Driver> driver_;
  std::unique_ptr<Watch> watch_;  // destroyed before the driver
};

}  // namespace omnimapper::drivers
