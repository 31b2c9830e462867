#pragma once

#include <mrpt/serialization/CSerializable.h>
#include <omnimapper/live/SensorSection.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace omnimapper::live {

/// A driver of MRPT (mrpt::hwdrivers::CGenericSensor) as a live run uses it, in one thread. Implemented by
/// the feature mrpt_drivers, which only makeDriver() and loadDrivers() load: MRPT's drivers depend on wxWidgets and
/// GTK, and a program that is linked with these takes half a second to start.
class SensorDriver {
 public:
  virtual ~SensorDriver() = default;

  /// Connects to the sensor. Throws the driver's own exceptions.
  virtual void open() = 0;
  /// The label of its observations: the sensorLabel of its section, or the driver's default.
  virtual std::string label() const = 0;
  /// [Hz] Rate at which read() should be called; 0 if the driver has none.
  virtual double rate() const = 0;
  /// Lets the driver work, and returns the objects that the driver has made since the last call, in the order of
  /// stamps. Throws the driver's own exceptions.
  virtual std::vector<mrpt::serialization::CSerializable::Ptr> read() = 0;
  /// Whether the driver reports that it failed.
  virtual bool hasFailed() const = 0;

  /// Keys of the driver's section that nothing reads. If the driver reads a key with a similar name, that key is named,
  /// too: "poze_z (did you mean pose_z?)".
  virtual std::vector<std::string> unreadKeys() const = 0;
  /// Number of messages or lines that were rejected as invalid since the driver was made; 0 if the driver checks none.
  virtual std::uint64_t leftOut() const = 0;
  /// Counts of the rejected messages or lines by reason, such as "2 malformed, 1 of more than 256 bytes".
  virtual std::string leftOutByReason() const = 0;
  /// Whether clients connect to the driver. If so, the driver is not reopened when it is silent, because reopening
  /// would only disconnect the clients.
  virtual bool waitsForOthers() const = 0;
  /// Whether the driver sends only what somebody asks for, so that its silence is not reported.
  virtual bool sendsOnRequest() const = 0;
};

/// Loads the feature mrpt_drivers, once. Throws Error(plugin_library) if it is not available.
void loadDrivers();

/// Makes the driver that a section names and passes it the section's keys, but does not open it. Throws
/// Error(plugin_library) as loadDrivers() does, Error(unknown_plugin) for a class that is not registered, which says
/// how to get it if a feature of the project has it, and Error(out_of_range) with the driver's own message if the keys
/// are invalid.
std::unique_ptr<SensorDriver> makeDriver(const SensorSection& section);

}  // namespace omnimapper::live

/// The function of the feature mrpt_drivers that makeDriver() calls. The caller owns the driver.
extern "C" omnimapper::live::SensorDriver* omnimapperMakeDriver(const omnimapper::live::SensorSection& section);
