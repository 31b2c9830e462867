#include <omnimapper/mapper/PluginHelp.h>
#include <omnimapper/mapper/PluginRegistry.h>

#include <algorithm>
#include <cctype>
#include <sstream>

namespace omnimapper::mapper {

namespace {

// '|' separates the columns of a Markdown table.
std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) result += c == '|' ? std::string("\\|") : std::string(1, c);
  return result;
}

void writeTable(std::ostream& out, const std::vector<base::OptionSpec>& specs) {
  if (specs.empty()) {
    out << "No options.\n\n";
    return;
  }
  out << "| key | type | default | range | meaning |\n|---|---|---|---|---|\n";
  for (const auto& spec : specs) {
    out << "| `" << spec.key << "` | " << spec.type << " | " << escaped(spec.default_value) << " | "
        << escaped(spec.range) << " | " << escaped(spec.help) << " |\n";
  }
  out << "\n";
}

std::string sectionNameFor(const std::string& class_name) {
  std::string name;
  for (const char c : class_name) {
    if (std::isupper(static_cast<unsigned char>(c)) && !name.empty()) name += '_';
    name += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  for (const std::string end : {"_plugin", "_output", "_extractor"}) {
    if (name.size() > end.size() && name.compare(name.size() - end.size(), end.size(), end) == 0) {
      name.resize(name.size() - end.size());
    }
  }
  return name;
}

}  // namespace

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
  return out.str();
}

std::string printIni(const std::string& class_name) {
  std::vector<std::string> known;
  for (const auto& factory : registeredFactories()) {
    known.push_back(factory->name());
    if (factory->name() != class_name) continue;
    std::ostringstream out;
    out << "; " << factory->summary() << "\n[" << sectionNameFor(class_name) << "]\nclass = " << class_name << "\n";
    for (const auto& spec : factory->options()) {
      out << "; " << spec.help << (spec.range.empty() ? "" : " (" + spec.range + ")") << "\n"
          << spec.key << " = " << spec.default_value << "\n";
    }
    return out.str();
  }
  const std::string near = base::nearestName(class_name, known);
  throw base::Error(base::ExitCode::unknown_plugin, "--print-ini: no plugin class is called '" + class_name + "'" +
                                                        (near.empty() ? "" : "; did you mean '" + near + "'?") +
                                                        " See --list-plugins.");
}

std::string iniReference(const FixedSections& fixed) {
  std::ostringstream out;
  out << "# Keys of the INI files\n\n"
         "Written by `omnimapper-graphslam --ini-reference` from the option tables in the code; a test keeps it so.\n"
         "A number is in the unit its key ends with. Unknown keys, wrong types and values out of range are errors.\n"
         "Comments start with `;`, `#` or `//`.\n\n";
  for (const auto& [name, specs] : fixed) {
    out << "## [" << name << "]\n\n";
    writeTable(out, specs);
  }
  out << "# Plugin classes\n\nEach plugin has a section of its own, named in `[mapper]` or `[perception]`, with a line "
         "`class = ...`.\n\n";
  for (const auto& factory : registeredFactories()) {
    out << "## " << factory->name() << " (" << toString(factory->kind()) << ")\n\n" << factory->summary() << "\n\n";
    writeTable(out, factory->options());
  }
  return out.str();
}

}  // namespace omnimapper::mapper
