#pragma once

#include <mrpt/hwdrivers/COpenNI2Sensor.h>

#include <memory>

namespace omnimapper::drivers {

/// MRPT's driver of an Xtion or another camera of OpenNI2, COpenNI2Sensor, with all its keys, behind what it lacks: it
/// ends the program where no camera is there, and waits for ever for the next frame of one that is unplugged.
class CCheckedOpenNI2 : public mrpt::hwdrivers::CGenericSensor {
  DEFINE_GENERIC_SENSOR(CCheckedOpenNI2)
 public:
  CCheckedOpenNI2();
  ~CCheckedOpenNI2() override;

  /// Throws base::Error(unreadable_input) if there is no camera; as MRPT's driver if that cannot open it.
  void initialize() override;
  /// Returns after the next frame of all its streams, or a tenth of a second. Throws base::Error(unreadable_input) if
  /// the camera is gone.
  void doProcess() override;

 protected:
  void loadConfig_sensorSpecific(const mrpt::config::CConfigFileBase& ini, const std::string& section) override;

 private:
  class Driver;
  class Watch;

  std::unique_ptr<mrpt::config::CConfigFileBase> ini_;
  std::string section_;
  std::unique_ptr<Driver> driver_;
  std::unique_ptr<Watch> watch_;  // goes before the driver
};

}  // namespace omnimapper::drivers
