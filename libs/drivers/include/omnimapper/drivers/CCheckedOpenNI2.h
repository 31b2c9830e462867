#pragma once

#include <mrpt/hwdrivers/COpenNI2Sensor.h>

#include <memory>

namespace omnimapper::drivers {

/// Wraps COpenNI2Sensor, MRPT's driver of an Xtion or another camera of OpenNI2, with all its keys, and adds two
/// checks: MRPT's driver ends the program if there is no camera, and waits for ever for the next frame of one that is
/// unplugged.
class CCheckedOpenNI2 : public mrpt::hwdrivers::CGenericSensor {
  DEFINE_GENERIC_SENSOR(CCheckedOpenNI2)
 public:
  CCheckedOpenNI2();
  ~CCheckedOpenNI2() override;

  /// Throws base::Error(unreadable_input) if there is no camera; as MRPT's driver if that cannot open it.
  void initialize() override;
  /// Returns after the next frame of all its streams, or after a tenth of a second. Throws
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
