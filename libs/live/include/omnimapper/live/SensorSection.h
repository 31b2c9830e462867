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
  /// Source of the stamps. automatic: the driver; if its clock is far from the host's, corrected by the estimated
  /// offset.
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

/// The sensors that [live] names, in the order in which they are to be opened: those of its list, then those of its
/// grabber INI, in the order of that file. Loads its libraries first, and makes each driver once to check its keys.
/// Throws Error as makeDriver(); command_line if there is none, unknown_key for a section that is not there or has no
/// driver, out_of_range for a label that two sensors have, unreadable_input for a grabber INI that cannot be read,
/// plugin_library for a library that cannot be loaded.
std::vector<SensorSection> readSensors(const LiveOptions& options, const base::Config& config);

/// The sensors of an INI of MRPT's rawlog-grabber: every section but [global] that is not marked
/// `rawlog-grabber-ignore = true`. Throws Error(unreadable_input, unknown_key) as readSensors().
std::vector<SensorSection> readGrabberIni(const std::string& path);

}  // namespace omnimapper::live
