#pragma once

#include <mrpt/config/CConfigFileMemory.h>
#include <omnimapper/base/Config.h>
#include <omnimapper/base/OptionTable.h>
#include <omnimapper/live/LiveOptions.h>

#include <memory>
#include <string>
#include <vector>

namespace omnimapper::live {

/// The keys of a sensor's section that --live itself reads, in addition to those of its driver.
struct SensorOptions {
  /// Source of the stamps. automatic: the driver; if the driver's clock is far from the host's, the estimated offset is
  /// added to its stamps.
  enum class Clock { automatic, driver, arrival };

  Clock clock = Clock::automatic;
  double clock_offset = 0;  ///< [s] that is added to every stamp of the driver

  static const base::OptionTable<SensorOptions>& table();
};

/// One sensor of a live run: a section of an INI file with its driver and the driver's keys.
struct SensorSection {
  std::string name;    ///< of the section
  std::string driver;  ///< class of mrpt::hwdrivers::CGenericSensor
  std::string label;   ///< sensorLabel of the section; empty: the driver's default
  std::string file;    ///< INI file of the section, for messages
  SensorOptions options;
  std::shared_ptr<const mrpt::config::CConfigFileMemory> ini;  ///< the INI that holds the section
};

/// The sensors that [live] names, in the order in which they are to be opened: first those of the key `sensors`, then
/// those of the INI that the key `grabber` names, in the order of that file. First loads the libraries of the key
/// `libraries`; at the end makes each driver once, to check its keys. Throws the errors of makeDriver(), and
/// Error(command_line) if there is no sensor, Error(unknown_key) for a section that does not exist or has no driver,
/// Error(wrong_type) for a pose that is no number, Error(out_of_range) for a label that two sensors have,
/// Error(unreadable_input) for a grabber INI that cannot be read, and Error(plugin_library) for a library that cannot
/// be loaded.
std::vector<SensorSection> readSensors(const LiveOptions& options, const base::Config& config);

/// The sensors of an INI of MRPT's rawlog-grabber: every section but [global] that is not marked
/// `rawlog-grabber-ignore = true`. Throws Error(unreadable_input), Error(unknown_key) and Error(wrong_type) as
/// readSensors() does.
std::vector<SensorSection> readGrabberIni(const std::string& path);

}  // namespace omnimapper::live
