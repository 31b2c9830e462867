#include <mrpt/rtti/CObject.h>
#include <mrpt/system/os.h>
#include <omnimapper/base/FeatureLibraries.h>
#include <omnimapper/mapper/EngineOptions.h>
#include <omnimapper/mapper/PluginRegistry.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <tuple>

namespace omnimapper::mapper {

std::string toString(PluginKind kind) {
  switch (kind) {
    case PluginKind::pose:
      return "pose plugin";
    case PluginKind::measurement:
      return "measurement plugin";
    case PluginKind::output:
      return "output plugin";
    case PluginKind::extractor:
      return "extractor";
  }
  return "";
}

std::vector<std::shared_ptr<const PluginFactory>> registeredFactories() {
  mrpt::rtti::registerAllPendingClasses();
  std::vector<std::shared_ptr<const PluginFactory>> factories;
  for (const auto* id : mrpt::rtti::getAllRegisteredClassesChildrenOf(CLASS_ID(PluginFactory))) {
    if (id->ptrCreateObject == nullptr) continue;  // an abstract one
    if (auto factory = std::dynamic_pointer_cast<const PluginFactory>(id->createObject())) factories.push_back(factory);
  }
  std::sort(factories.begin(), factories.end(), [](const auto& a, const auto& b) {
    return std::make_tuple(a->kind(), a->name()) < std::make_tuple(b->kind(), b->name());
  });
  return factories;
}

Kinds registeredKinds() {
  Kinds kinds;
  for (const auto& factory : registeredFactories()) factory->registerKinds(kinds);
  return kinds;
}

std::shared_ptr<const PluginFactory> findFactory(PluginKind kind, const std::string& name, const std::string& place) {
  std::vector<std::string> known;
  for (const auto& factory : registeredFactories()) {
    if (factory->kind() != kind) continue;
    if (factory->name() == name) return factory;
    known.push_back(factory->name());
  }
  if (const auto why = base::whyUnavailable(name); !why.empty())
    throw base::Error(base::ExitCode::unknown_plugin, place + ": '" + name + "' is not available: " + why);
  const std::string near = base::nearestName(name, known);
  throw base::Error(base::ExitCode::unknown_plugin, place + ": no " + toString(kind) + " is called '" + name + "'" +
                                                        (near.empty() ? "" : "; did you mean '" + near + "'?") +
                                                        " (known: " + base::option_text::format(known) +
                                                        "; others come from [mapper] plugin_libraries)");
}

void loadPluginLibrary(const std::string& path) {
  std::string problem;
  if (!mrpt::system::loadPluginModule(path, problem)) {
    throw base::Error(
        base::ExitCode::plugin_library,
        "[mapper] plugin_libraries: cannot load '" + path + "' (" + problem +
            "); give its full path, or a path relative to the INI's folder (with --set, to the working directory)");
  }
}

void loadPluginLibraries(const base::Config& config) {
  const auto paths = config.section("mapper").read<EngineOptions>().plugin_libraries;
  if (!paths.empty() && !config.isTrusted("mapper", "plugin_libraries")) {
    throw base::Error(base::ExitCode::plugin_library,
                      config.placeOf("mapper", "plugin_libraries") +
                          ": [mapper] plugin_libraries loads program code. It is accepted only in the first INI, and "
                          "not in one that was written from a log: put it there, or give it with --set");
  }
  const bool is_from_command_line = config.isFromCommandLine("mapper", "plugin_libraries");
  const auto folder = std::filesystem::path(is_from_command_line ? "" : config.firstFile()).parent_path();
  for (const auto& path : paths) loadPluginLibrary(std::filesystem::absolute(folder / path).string());
}

namespace {

std::string withArticle(PluginKind kind) {
  const std::string name = toString(kind);
  return (name.front() == 'o' || name.front() == 'e' ? "an " : "a ") + name;
}

bool isDefault(const std::string& name, const base::Config& config) {
  const auto defaults = config.section("mapper").read<EngineOptions>().default_plugins;
  std::string class_name;
  return std::count(defaults.begin(), defaults.end(), name) > 0 &&
         (!config.has(name) || !config.section(name).find("class", class_name));
}

// A name without a section is probably misspelt in the list of sections.
[[noreturn]] void failWithoutSection(const std::string& name, PluginKind kind, const base::Config& config) {
  std::string key = toString(kind) + "s";
  std::replace(key.begin(), key.end(), ' ', '_');
  const std::string section = kind == PluginKind::extractor ? "perception" : "mapper";
  const std::string near = base::nearestName(name, config.switchedOffPlugins());
  throw base::Error(base::ExitCode::unknown_plugin, config.placeOf(section, key) + ": [" + section + "] " + key +
                                                        " names '" + name + "', and there is no section [" + name +
                                                        "] with a line 'class = ...'" +
                                                        (near.empty() ? "" : "; did you mean '" + near + "'?"));
}

template <class Factory, class Plugin>
void makeAll(const std::vector<std::string>& names, PluginKind kind, const base::Config& config, PluginContext context,
             std::vector<Named<Plugin>>& plugins) {
  std::set<std::string> made;
  for (const auto& name : names) {
    if (!made.insert(name).second) {
      throw base::Error(base::ExitCode::out_of_range, config.file() + ": the " + toString(kind) + " [" + name +
                                                          "] is named twice; name it once, or give the second a " +
                                                          "section of its own");
    }
    constexpr std::size_t kLongest = 200;  // with more a map file could not hold the plugin's state
    if (name.size() > kLongest) {
      throw base::Error(base::ExitCode::out_of_range, config.file() + ": the name of a " + toString(kind) + " is " +
                                                          std::to_string(name.size()) + " bytes long; give it one of " +
                                                          "at most " + std::to_string(kLongest));
    }
    const auto factory = factoryOfSection(kind, name, config);
    context.section = name;
    plugins.push_back({name, dynamic_cast<const Factory&>(*factory).make(config.section(name), context)});
  }
}

}  // namespace

std::vector<std::string> measurementSections(const base::Config& config) {
  const auto options = config.section("mapper").read<EngineOptions>();
  std::set<std::string> listed, known;  // classes
  for (const auto& section : options.measurement_plugins) {
    std::string class_name = section;
    if (config.has(section)) config.section(section).find("class", class_name);
    listed.insert(class_name);
  }
  for (const auto& factory : registeredFactories()) known.insert(factory->name());
  std::vector<std::string> sections;
  for (const auto& class_name : options.default_plugins)
    if (listed.count(class_name) == 0 && known.count(class_name) > 0) sections.push_back(class_name);
  sections.insert(sections.end(), options.measurement_plugins.begin(), options.measurement_plugins.end());
  return sections;
}

std::shared_ptr<const PluginFactory> factoryOfSection(PluginKind kind, const std::string& name,
                                                      const base::Config& config) {
  if (kind == PluginKind::measurement && isDefault(name, config)) {
    return findFactory(kind, name, config.placeOf("mapper", "default_plugins"));
  }
  if (!config.has(name)) failWithoutSection(name, kind, config);
  const std::string place = config.placeOf(name, "class") + ": [" + name + "]";
  std::string class_name;
  if (!config.section(name).find("class", class_name)) {
    throw base::Error(base::ExitCode::unknown_plugin,
                      place + ": the section of " + withArticle(kind) + " needs a line 'class = ...'");
  }
  return findFactory(kind, class_name, place + " class");
}

namespace {

// Where an INI that may come from anywhere sets something of the output; empty if it does not.
std::string untrustedPlaceOf(const std::string& section, const PluginFactory& factory, bool is_listed,
                             const base::Config& config) {
  if (is_listed && !config.isTrusted("mapper", "output_plugins")) return config.placeOf("mapper", "output_plugins");
  std::vector<std::string> keys{"class"};
  for (const auto& option : factory.options()) keys.push_back(option.key);
  for (const auto& key : keys)
    if (!config.isTrusted(section, key)) return config.placeOf(section, key);
  return "";
}

}  // namespace

OutputSections outputSections(const base::Config& config, const std::vector<std::string>& more_outputs) {
  auto asked = config.section("mapper").read<EngineOptions>().output_plugins;
  const std::set<std::string> more(more_outputs.begin(), more_outputs.end());
  for (const auto& section : more_outputs)
    if (std::count(asked.begin(), asked.end(), section) == 0) asked.push_back(section);
  OutputSections sections;
  for (const auto& section : asked) {
    const auto factory = factoryOfSection(PluginKind::output, section, config);
    const std::string place =
        factory->needsTrust() ? untrustedPlaceOf(section, *factory, more.count(section) == 0, config) : "";
    if (place.empty()) {
      sections.made.push_back(section);
    } else {
      config.section(section);  // it is known
      sections.left_out.push_back(place + ": [" + section + "] is left out: " + factory->name() +
                                  " lets others in, so only the first INI or the command line may name and set it");
    }
  }
  return sections;
}

PluginSet makePlugins(const PluginSections& sections, const base::Config& config, PluginContext context) {
  PluginSet set;
  makeAll<PosePluginFactory>(sections.pose, PluginKind::pose, config, context, set.pose);
  makeAll<ExtractorFactory>(sections.extractors, PluginKind::extractor, config, context, set.extractors);
  makeAll<MeasurementPluginFactory>(sections.measurement, PluginKind::measurement, config, context, set.measurement);
  makeAll<OutputPluginFactory>(sections.output, PluginKind::output, config, context, set.output);
  return set;
}

}  // namespace omnimapper::mapper
