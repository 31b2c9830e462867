#include <mrpt/hwdrivers/CGenericSensor.h>
#include <mrpt/system/COutputLogger.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/base/Exceptions.h>
#include <omnimapper/base/FeatureLibraries.h>
#include <omnimapper/base/Names.h>
#include <omnimapper/drivers/CheckedSensor.h>
#include <omnimapper/live/SensorDriver.h>

#include <exception>
#include <stdexcept>
#include <utility>

#include "WatchedIni.h"

namespace omnimapper::drivers {

namespace {

using mrpt::hwdrivers::CGenericSensor;

class MrptDriver : public live::SensorDriver {
 public:
  MrptDriver(CGenericSensor::Ptr sensor, std::vector<std::string> unread_keys)
      : sensor_(std::move(sensor)),
        checked_(dynamic_cast<const CheckedSensor*>(sensor_.get())),
        unread_keys_(std::move(unread_keys)) {}

  void open() override {
    sensor_->initialize();
    if (hasFailed()) throw std::runtime_error("its driver cannot set it up");
  }
  std::string label() const override { return base::sensorName(sensor_->getSensorLabel()); }
  double rate() const override { return sensor_->getProcessRate(); }
  std::vector<mrpt::serialization::CSerializable::Ptr> read() override {
    sensor_->doProcess();
    std::vector<mrpt::serialization::CSerializable::Ptr> objects;
    for (const auto& [stamp, object] : sensor_->getObservations()) objects.push_back(object);
    return objects;
  }
  bool hasFailed() const override { return sensor_->getState() == CGenericSensor::ssError; }
  std::vector<std::string> unreadKeys() const override { return unread_keys_; }
  std::uint64_t leftOut() const override { return checked_ ? checked_->leftOut() : 0; }
  std::string leftOutByReason() const override { return checked_ ? checked_->leftOutByReason() : ""; }
  bool waitsForOthers() const override { return checked_ && checked_->waitsForOthers(); }
  bool sendsOnRequest() const override { return checked_ && checked_->sendsOnRequest(); }

 private:
  CGenericSensor::Ptr sensor_;
  const CheckedSensor* checked_;  // null if the driver is no CheckedSensor
  std::vector<std::string> unread_keys_;
};

// The driver that reads the device instead of one that MRPT was built without; null if there is none.
const char* insteadOf(const std::string& driver) {
  return driver == "CKinect" ? "KinectSensor" : nullptr;
}

// The checked version of MRPT's driver if this library has one, else the driver itself.
std::string checkedDriver(const std::string& driver) {
  if (driver == "CHokuyoURG") return "CCheckedHokuyo";
  return driver == "COpenNI2Sensor" ? "CCheckedOpenNI2" : driver;
}

base::Error noDriver(const std::string& where, const std::string& driver) {
  const std::string why = base::whyUnavailable(driver);
  return base::Error(base::ExitCode::unknown_plugin,
                     where + "there is no driver " + driver + "; " +
                         (why.empty() ? "it is a class of mrpt::hwdrivers, such as CHokuyoURG, or of a library that "
                                        "[live] libraries names"
                                      : why));
}

std::unique_ptr<live::SensorDriver> makeDriver(const live::SensorSection& section) {
  base::loadFeaturesOf(base::Registered::driver);
  const std::string where = section.file + ": sensor [" + section.name + "]: ";
  if (const char* instead = insteadOf(section.driver))
    throw base::Error(base::ExitCode::unknown_plugin, where + "MRPT was built without the library that " +
                                                          section.driver + " needs; write driver = " + instead);
  const auto sensor = [&] {
    try {
      return CGenericSensor::createSensorPtr(checkedDriver(section.driver));
    } catch (const std::exception& error) {  // a class that MRPT declares but was built without
      throw base::Error(base::ExitCode::unknown_plugin, where + base::sentenceOf(error));
    }
  }();
  if (!sensor) throw noDriver(where, section.driver);
  if (auto* logger = dynamic_cast<mrpt::system::COutputLogger*>(sensor.get()))
    logger->setMinLoggingLevel(mrpt::system::LVL_ERROR);
  const WatchedIni ini(*section.ini);
  try {
    sensor->loadConfig(ini, section.name);
  } catch (const base::Error& error) {
    throw base::Error(error.code(), where + base::sentenceOf(error));
  } catch (const std::exception& error) {
    throw base::Error(base::ExitCode::out_of_range, where + base::sentenceOf(error));
  }
  return std::make_unique<MrptDriver>(sensor, ini.unreadKeys(section.name));
}

}  // namespace

}  // namespace omnimapper::drivers

extern "C" omnimapper::live::SensorDriver* omnimapperMakeDriver(const omnimapper::live::SensorSection& section) {
  return omnimapper::drivers::makeDriver(section).release();
}
