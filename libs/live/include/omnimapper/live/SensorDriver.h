#pragma once

#include <mrpt/serialization/CSerializable.h>
#include <omnimapper/live/SensorSection.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace omnimapper::live {

/// A driver of MRPT (mrpt::hwdrivers::CGenericSensor) as a live run uses it, in one thread. Implemented by
/// libomnimapper-drivers, which makeDriver() loads: MRPT's drivers bring wxWidgets and GTK with them, with which every
/// program would take half a second to start.
class SensorDriver {
 public:
  virtual ~SensorDriver() = default;

  /// Connects to the sensor. Throws what the driver throws, in its words.
  virtual void open() = 0;
  /// Under which its observations come: the sensorLabel of its section, or the driver's own.
  virtual std::string label() const = 0;
  /// [Hz] at which it wants read() to be called; 0 if it does not say.
  virtual double rate() const = 0;
  /// Lets the driver work, and takes what it has got since the last call, by stamp. Throws as open().
  virtual std::vector<mrpt::serialization::CSerializable::Ptr> read() = 0;
  /// Whether it says of itself that it failed.
  virtual bool hasFailed() const = 0;

  /// Keys of its section that nobody reads, each with the nearest that is read: "poze_z (did you mean pose_z?)".
  virtual std::vector<std::string> unreadKeys() const = 0;
  /// Messages or lines that were left out as malformed or impossible since the driver was made, where it checks them.
  virtual std::uint64_t leftOut() const = 0;
  /// How many of what kind, such as "2 malformed, 1 of more than 256 bytes".
  virtual std::string leftOutByReason() const = 0;
  /// Whether others connect to it: to open it again when it is silent would only turn them away.
  virtual bool waitsForOthers() const = 0;
};

/// Loads libomnimapper-drivers, once. Throws Error(plugin_library) if it is not beside the other libraries.
void loadDrivers();

/// A driver with its keys, not opened yet. Throws Error as loadDrivers(), Error(unknown_plugin) for a class that nobody
/// registered, and Error(out_of_range) with the driver's own words where its keys do not suit it.
std::unique_ptr<SensorDriver> makeDriver(const SensorSection& section);

}  // namespace omnimapper::live

/// What libomnimapper-drivers exports: makeDriver() calls it. The caller owns the driver.
extern "C" omnimapper::live::SensorDriver* omnimapperMakeDriver(const omnimapper::live::SensorSection& section);
