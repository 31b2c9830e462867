#include <omnimapper/base/FeatureLibraries.h>
#include <omnimapper/base/OptionHelp.h>
#include <omnimapper/mapper/PluginHelp.h>
#include <omnimapper/mapper/PluginRegistry.h>
#include <omnimapper/source/SourceFactory.h>

#include <algorithm>
#include <sstream>

namespace omnimapper::mapper {

std::string listPlugins() {
  const auto factories = registeredFactories();
  std::size_t width = 0;
  for (const auto& factory : factories) width = std::max(width, factory->name().size());
  std::ostringstream out;
  std::string heading;
  for (const auto& factory : factories) {
    if (toString(factory->kind()) != heading) {
      heading = toString(factory->kind());
      out << heading << "s\n";
    }
    out << "  " << factory->name() << std::string(width + 2 - factory->name().size(), ' ') << factory->summary()
        << "\n";
  }
  const auto formats = source::registeredFormats();
  if (!formats.empty()) out << "formats of logs\n";
  for (const auto& format : formats) {
    const std::string name = format->name();
    out << "  " << name << std::string(width + 2 - std::min(width, name.size()), ' ') << format->summary() << "\n";
  }
  return out.str();
}

std::string printIni(const std::string& class_name) {
  std::vector<std::string> known;
  for (const auto& factory : registeredFactories()) {
    known.push_back(factory->name());
    if (factory->name() != class_name) continue;
    return base::optionsAsIni(base::sectionNameFor(class_name, {"_plugin", "_output", "_extractor"}), class_name,
                              factory->summary(), factory->options());
  }
  if (const auto why = base::whyUnavailable(class_name); !why.empty())
    throw base::Error(base::ExitCode::unknown_plugin, "--print-ini: '" + class_name + "' is not available: " + why);
  std::string near = base::nearestName(class_name, known);
  for (const char* ending : {"Plugin", "Extractor", "Output"})
    if (near.empty()) near = base::nearestName(class_name + ending, known);
  throw base::Error(base::ExitCode::unknown_plugin, "--print-ini: no plugin class is called '" + class_name + "'" +
                                                        (near.empty() ? "." : "; did you mean '" + near + "'?") +
                                                        " See --list-plugins.");
}

std::string iniReference(const FixedSections& fixed) {
  std::ostringstream out;
  out << "# Keys of the INI files\n\n"
         "Written by `omnimapper-graphslam --ini-reference` from the option tables in the code; a test keeps it so.\n"
         "A number is in the unit with which its key ends (such as _m or _deg), or in the unit that its text has in "
         "brackets. Unknown keys, wrong types and values out of range are errors.\n"
         "Comments start with `;`, `#` or `//`.\n\n";
  for (const auto& [name, specs] : fixed) {
    out << "## [" << name << "]\n\n" << base::optionsAsMarkdown(specs);
  }
  for (const auto& format : source::registeredFormats()) {
    out << "## [" << source::sectionOfFormat(format->name()) << "]\n\nFor `-r` with " << format->summary() << ".\n\n"
        << base::optionsAsMarkdown(format->options());
  }
  out << "# Plugin classes\n\nEach plugin has a section of its own, whose name is free and is listed in `[mapper]` or "
         "`[perception]`. In the section, `class = ...` names one of these classes.\n\n";
  for (const auto& factory : registeredFactories()) {
    out << "## " << factory->name() << " (" << toString(factory->kind()) << ")\n\n"
        << factory->summary() << "\n\n"
        << base::optionsAsMarkdown(factory->options());
  }
  return out.str();
}

}  // namespace omnimapper::mapper
