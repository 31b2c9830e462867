#include <omnimapper/base/Config.h>
#include <omnimapper/drivers/readDriverSection.h>
#include <omnimapper/live/SensorSection.h>

#include <algorithm>

namespace omnimapper::drivers {

void refuseUnknownKeys(const mrpt::config::CConfigFileBase& ini, const std::string& section,
                       const std::vector<base::OptionSpec>& specs) {
  // Keys that mrpt::hwdrivers::CGenericSensor::loadConfig(), rawlog-grabber and --live read in the section of every
  // driver.
  std::vector<std::string> known{"driver",
                                 "sensorLabel",
                                 "process_rate",
                                 "grab_decimation",
                                 "max_queue_len",
                                 "external_images_format",
                                 "external_images_jpeg_quality",
                                 "rawlog-grabber-ignore"};
  for (const auto& spec : live::SensorOptions::table().specs()) known.push_back(spec.key);
  for (const auto& spec : specs) known.push_back(spec.key);
  std::vector<std::string> keys;
  ini.getAllKeys(section, keys);
  for (const auto& key : keys) {
    if (std::find(known.begin(), known.end(), key) != known.end()) continue;
    const std::string nearest = base::nearestName(key, known);
    throw base::Error(base::ExitCode::unknown_key, "[" + section + "] has no key '" + key + "'" +
                                                       (nearest.empty() ? "" : "; did you mean " + nearest + "?"));
  }
}

}  // namespace omnimapper::drivers
