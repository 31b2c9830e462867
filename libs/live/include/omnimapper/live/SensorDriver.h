#pragma once

#include <mrpt/serialization/CSerializable.h>
#include <omnimapper/live/SensorSection.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace omnimapper::live {

/// A driver of MRPT (mrpt::hwdrivers::CGenericSensor) as a live run uses it, in one thread. Implemented by
/// libomnimapper-drivers, which makeDriver() loads: MRPT's drivers depend on wxWidgets and GTK, with which every
/// program would take half a second to start.
class SensorDriver {
 public:
  virtual ~SensorDriver() = default;

  /// Connects to the sensor. Throws the driver's own exceptions.
  virtual void open() = 0;
  /// The label of its observations: the sensorLabel of its section, or the driver's default.
  virtual std::string label() const = 0;
  /// [Hz] Rate at which read() should be called; 0 if the driver has none.
  virtual double rate() const = 0;
  /// Lets the driver work, and returns the objects that it has made since the last call, by stamp. Throws as open().
  virtual std::vector<mrpt::serialization::CSerializable::Ptr> read() = 0;
  /// Whether the driver reports that it failed.
  virtual bool hasFailed() const = 0;

  /// Keys of its section that are not read. If a similar key is read, it is named: "poze_z (did you mean pose_z?)".
  virtual std::vector<std::string> unreadKeys() const = 0;
  /// Number of messages or lines that were rejected as invalid since the driver was made; 0 if it does not check them.
  virtual std::uint64_t leftOut() const = 0;
  /// Their counts by kind, such as "2 malformed, 1 of more than 256 bytes".
  virtual std::string leftOutByReason() const = 0;
  /// Whether clients connect to it. If so, it is not reopened when it is silent, because that would only disconnect
  /// them.
  virtual bool waitsForOthers() const = 0;
};

/// Loads libomnimapper-drivers, once. Throws Error(plugin_library) if it is not beside the other libraries.
void loadDrivers();

/// Makes a driver with its keys, without opening it. Throws Error as loadDrivers(), Error(unknown_plugin) for a class
/// that is not registered, and Error(out_of_range) with the driver's own message if its keys are invalid.
std::unique_ptr<SensorDriver> makeDriver(const SensorSection& section);

}  // namespace omnimapper::live

/// The function of libomnimapper-drivers that makeDriver() calls. The caller owns the driver.
extern "C" omnimapper::live::SensorDriver* omnimapperMakeDriver(const omnimapper::live::SensorSection& section);
