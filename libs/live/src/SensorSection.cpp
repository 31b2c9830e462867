#include <dlfcn.h>
#include <omnimapper/base/InputFile.h>
#include <omnimapper/base/Names.h>
#include <omnimapper/live/SensorDriver.h>
#include <omnimapper/live/SensorSection.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <set>

namespace omnimapper::live {

namespace {

using mrpt::config::CConfigFileMemory;

const std::string kDriver = "driver", kLabel = "sensorLabel";

[[noreturn]] void throwNoDriver(const SensorSection& section) {
  throw base::Error(base::ExitCode::unknown_key, section.file + ": sensor [" + section.name +
                                                     "] has no key driver; name the class that reads it, such "
                                                     "as driver = CHokuyoURG");
}

// MRPT's drivers read "9o" as 9 and "left" as 0.
void requireNumbers(const CConfigFileMemory& ini, const SensorSection& section) {
  for (const char* key : {"pose_x", "pose_y", "pose_z", "pose_yaw", "pose_pitch", "pose_roll"}) {
    const std::string text = ini.read_string(section.name, key, "0");
    const std::string word = text.substr(0, text.find_first_of(" \t;/"));  // a comment may follow
    char* end = nullptr;
    const bool is_number = std::isfinite(std::strtod(word.c_str(), &end)) && end == word.c_str() + word.size();
    if (word.empty() || !is_number)
      throw base::Error(base::ExitCode::wrong_type,
                        section.file + ": sensor [" + section.name + "]: " + key + " = " + text + " is no number");
  }
}

SensorSection sectionOf(const std::string& name, const std::string& file,
                        const std::shared_ptr<const CConfigFileMemory>& ini) {
  SensorSection section;
  section.name = name;
  section.file = file;
  section.driver = ini->read_string(name, kDriver, "");
  section.label = base::sensorName(ini->read_string(name, kLabel, ""));
  section.ini = ini;
  if (section.driver.empty()) throwNoDriver(section);
  requireNumbers(*ini, section);
  return section;
}

// The path of the grabber INI, relative to the folder of the INI that names it, or of the first INI.
std::string pathOfGrabber(const LiveOptions& options, const base::Config& config) {
  namespace fs = std::filesystem;
  const std::string place = config.placeOf("live", "grabber");  // FILE:LINE, or the command line
  const auto named = fs::path(place.substr(0, place.rfind(':'))).parent_path() / options.grabber;
  if (fs::exists(named)) return named.string();
  return (fs::path(config.firstFile()).parent_path() / options.grabber).string();
}

void loadLibraries(const LiveOptions& options, const base::Config& config) {
  if (!options.libraries.empty()) loadDrivers();  // their classes derive from MRPT's, which this loads
  for (const auto& library : options.libraries) {
    if (!config.isTrusted("live", "libraries"))
      throw base::Error(base::ExitCode::plugin_library,
                        config.placeOf("live", "libraries") +
                            ": libraries are loaded only where the first INI or the command line names them");
    if (!dlopen(library.c_str(), RTLD_NOW | RTLD_GLOBAL))
      throw base::Error(base::ExitCode::plugin_library, config.placeOf("live", "libraries") + ": " + dlerror());
  }
}

// Makes each driver once, so that errors in its keys are found before the run begins.
void tryDrivers(const std::vector<SensorSection>& sensors) {
  std::set<std::string> labels;
  for (const auto& sensor : sensors) {
    const std::string label = makeDriver(sensor)->label();
    if (labels.insert(label).second) continue;
    throw base::Error(
        base::ExitCode::out_of_range,
        sensor.file + ": sensor [" + sensor.name + "] has the sensorLabel " + label +
            " of another sensor; give each sensor a different one, because observations are assigned by it");
  }
}

}  // namespace

const base::OptionTable<SensorOptions>& SensorOptions::table() {
  static const auto table =
      base::OptionTable<SensorOptions>()
          .choice("clock", &SensorOptions::clock,
                  {{"automatic", Clock::automatic}, {"driver", Clock::driver}, {"arrival", Clock::arrival}},
                  "Source of an observation's stamp. driver: the driver's own stamp. arrival: the time at which the "
                  "observation arrives. automatic: the driver's stamp, corrected by an estimated offset if the "
                  "driver's clock is not the computer's.")
          .number("clock_offset_s", &SensorOptions::clock_offset, base::Range(),
                  "Time that is added to every stamp of the driver. It is negative if the stamps are late, for example "
                  "by a known latency.");
  return table;
}

std::vector<SensorSection> readGrabberIni(const std::string& path) {
  const auto ini = std::make_shared<CConfigFileMemory>();
  try {
    ini->setContent(base::readInput(path, "INI of rawlog-grabber"));
  } catch (const base::Error&) {
    throw;
  } catch (const std::exception& error) {  // MRPT expands ${name}, $env{NAME} and $eval{expression} in values
    throw base::Error(base::ExitCode::unreadable_input, path + ": " + error.what());
  }
  std::vector<std::string> names;
  ini->getAllSections(names);
  std::vector<SensorSection> sensors;
  for (const auto& name : names) {
    if (name.empty() || name == "global" || ini->read_bool(name, "rawlog-grabber-ignore", false)) continue;
    sensors.push_back(sectionOf(name, path, ini));
  }
  return sensors;
}

std::vector<SensorSection> readSensors(const LiveOptions& options, const base::Config& config) {
  loadLibraries(options, config);
  const auto ini = std::make_shared<CConfigFileMemory>();
  ini->setContent(config.text());
  std::vector<SensorSection> sensors;
  for (const auto& name : options.sensors) {
    if (!config.has(name))
      throw base::Error(base::ExitCode::unknown_key, config.placeOf("live", "sensors") + ": there is no section [" +
                                                         name + "] for this sensor; write one with its driver");
    sensors.push_back(sectionOf(name, config.placeOf(name), ini));
    std::vector<std::string> keys;
    ini->getAllKeys(name, keys);  // the driver itself checks its own keys
    sensors.back().options = config.section(name).read<SensorOptions>(keys);
  }
  if (!options.grabber.empty()) {
    const auto more = readGrabberIni(pathOfGrabber(options, config));
    sensors.insert(sensors.end(), more.begin(), more.end());
  }
  if (sensors.empty())
    throw base::Error(base::ExitCode::command_line,
                      config.file() +
                          ": --live needs sensors: name them in [live] sensors, each with a section of its own "
                          "(driver = CHokuyoURG), or name an INI of rawlog-grabber in [live] grabber");
  tryDrivers(sensors);
  return sensors;
}

}  // namespace omnimapper::live
