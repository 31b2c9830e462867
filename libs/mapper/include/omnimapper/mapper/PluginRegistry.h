#pragma once

#include <omnimapper/plugin/PluginFactory.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace omnimapper::mapper {

/// Every factory that is registered with MRPT at the time of the call, sorted by kind, then name.
std::vector<std::shared_ptr<const PluginFactory>> registeredFactories();

/// The kinds that the plugins of all registered factories put into maps, in addition to those of `graph` itself.
Kinds registeredKinds();

/// The factory for `class = name` in an INI. Throws Error(unknown_plugin), naming the most similar known class, or why
/// the class is not available. `place`: where the INI names the class, for the message.
std::shared_ptr<const PluginFactory> findFactory(PluginKind kind, const std::string& name, const std::string& place);

/// The sections of the measurement plugins of an INI: those of [mapper] default_plugins, unless no loaded library has
/// the class or a listed plugin is of it, and after them the listed ones. A default plugin's section is named by its
/// class.
std::vector<std::string> measurementSections(const base::Config& config);

/// The sections of the outputs of a run.
struct OutputSections {
  std::vector<std::string> made;
  std::vector<std::string>
      left_out;  ///< a sentence on each that the INI names, but may not (PluginFactory::needsTrust)
};
/// The outputs of [mapper] output_plugins and those that the command line adds. Throws as makePlugins().
OutputSections outputSections(const base::Config& config, const std::vector<std::string>& more_outputs);

/// The factory of the class that the section `name` names; a default plugin needs no section. Throws as makePlugins().
std::shared_ptr<const PluginFactory> factoryOfSection(PluginKind kind, const std::string& name,
                                                      const base::Config& config);

/// Loads a shared library that registers factories (mrpt::system::loadPluginModule). Throws Error(plugin_library).
void loadPluginLibrary(const std::string& path);
/// Loads the libraries that [mapper] plugin_libraries of an INI names. Throws as loadPluginLibrary() and
/// base::ConfigSection::read().
void loadPluginLibraries(const base::Config& config);

/// A plugin with the name of its INI section; its factors and decisions have this name as their owner.
template <class Plugin>
struct Named {
  std::string section;
  std::unique_ptr<Plugin> plugin;
};

/// The plugins of one run, in the order the INI lists them.
struct PluginSet {
  std::vector<Named<PosePlugin>> pose;
  std::vector<Named<perception::Extractor>> extractors;
  std::vector<Named<MeasurementPlugin>> measurement;
  std::vector<Named<OutputPlugin>> output;
};

/// Sections of plugins, as [mapper] and [perception] of an INI list them.
struct PluginSections {
  std::vector<std::string> pose, extractors, measurement, output;
};

/// A change of the plugins of a run while it goes on (thesis 5.3.2.1).
struct PluginChange {
  std::vector<std::string> removed;  ///< sections of plugins of any kind
  PluginSet added;                   ///< a section that is also in `removed` is a plugin with new settings
  PluginSections order;              ///< all plugins after the change, in their order
  /// Readers of layers that were kept as bytes so far, if libraries of plugins were loaded for the change.
  std::optional<map::LayerRegistry> layers;
};

/// Makes every plugin from its section. Throws base::Error as findFactory() and the factories do.
PluginSet makePlugins(const PluginSections& sections, const base::Config& config, PluginContext context);

/// "pose plugin" and so on, for use in messages.
std::string toString(PluginKind kind);

}  // namespace omnimapper::mapper
