#include <omnimapper/base/OptionHelp.h>
#include <omnimapper/sim/Drive.h>
#include <omnimapper/sim/Simulation.h>
#include <omnimapper/sim/SimulationHelp.h>
#include <omnimapper/sim_world/WorldIni.h>

#include <algorithm>
#include <sstream>

namespace omnimapper::sim {

namespace {

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const auto& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

std::vector<base::OptionSpec> allOptionsOf(const SensorClass& sensor) {
  auto options = SensorOptions::table().specs();
  options.insert(options.end(), sensor.options.begin(), sensor.options.end());
  return options;
}

}  // namespace

std::string listClasses() {
  std::ostringstream out;
  out << "sections that [world] names\n";
  for (const auto& section : worldSectionReferences())
    out << "  " << section.list << ": class = " << joined(section.class_names) << "\n";
  out << "sensors, which [simulation] sensors names\n";
  std::size_t width = 0;
  for (const auto& sensor : sensorClasses()) width = std::max(width, sensor.name.size());
  for (const auto& sensor : sensorClasses())
    out << "  " << sensor.name << std::string(width + 2 - sensor.name.size(), ' ') << sensor.summary << "\n";
  return out.str();
}

std::string printIni(const std::string& class_name) {
  std::vector<std::string> known;
  for (const auto& sensor : sensorClasses()) {
    known.push_back(sensor.name);
    if (sensor.name == class_name)
      return base::optionsAsIni(base::sectionNameFor(class_name, {}), class_name, sensor.summary, allOptionsOf(sensor),
                                sensor.of_model);
  }
  for (const auto& section : worldSectionReferences()) {
    for (const auto& name : section.class_names) {
      known.push_back(name);
      if (name == class_name) {
        return base::optionsAsIni(base::sectionNameFor(class_name, {}), class_name,
                                  "One of [world] " + section.list + ".", section.options);
      }
    }
  }
  const std::string near = base::nearestName(class_name, known);
  throw base::Error(base::ExitCode::unknown_plugin, "--print-ini: no class is called '" + class_name + "'" +
                                                        (near.empty() ? "" : "; did you mean '" + near + "'?") +
                                                        " See --list.");
}

std::string iniReference() {
  std::ostringstream out;
  out << "# Keys of the simulator's INI files\n\n"
         "Written by `omnimapper-simulate --ini-reference` from the option tables in the code; a test keeps it so.\n"
         "A number is in the unit with which its key ends (such as _m or _deg), or in the unit that its text has in "
         "brackets. Unknown keys, wrong types and values out of range are errors.\n"
         "Comments start with `;`, `#` or `//`. Examples: the INI files of [rawlogs](../rawlogs/README.md).\n\n"
      << "## [simulation]\n\n"
      << base::optionsAsMarkdown(SimulationOptions::table().specs()) << "## [robot]\n\n"
      << base::optionsAsMarkdown(DriveOptions::table().specs()) << "## [world]\n\n"
      << base::optionsAsMarkdown(WorldOptions::table().specs());
  const auto sections = worldSectionReferences();
  for (const auto& section : sections) {
    const bool is_split = std::count_if(sections.begin(), sections.end(),
                                        [&](const auto& other) { return other.list == section.list; }) > 1;
    out << "## Sections of `[world] " << section.list << "`"
        << (is_split ? " with `class = " + joined(section.class_names) + "`"
                     : "\n\n`class` is one of " + joined(section.class_names) + ".")
        << "\n\n"
        << base::optionsAsMarkdown(section.options);
  }
  out << "# Sensors\n\nEach has a section of its own, named in `[simulation] sensors`, with a line `class = ...`.\n\n"
         "## Keys of every sensor\n\n"
      << base::optionsAsMarkdown(SensorOptions::table().specs());
  for (const auto& sensor : sensorClasses())
    out << "## " << sensor.name << "\n\n" << sensor.summary << "\n\n" << base::optionsAsMarkdown(sensor.options);
  return out.str();
}

}  // namespace omnimapper::sim
