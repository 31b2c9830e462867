#pragma once

#include <mrpt/rtti/CObject.h>
#include <omnimapper/base/Config.h>
#include <omnimapper/graph/FactorRegistry.h>
#include <omnimapper/map/Layers.h>
#include <omnimapper/map/PayloadRegistry.h>
#include <omnimapper/perception/Extractor.h>
#include <omnimapper/plugin/MeasurementPlugin.h>
#include <omnimapper/plugin/Motion.h>
#include <omnimapper/plugin/OutputPlugin.h>
#include <omnimapper/plugin/PosePlugin.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace omnimapper::mapper {

using perception::DerivedName;
using perception::Extractor;

/// What every plugin is given about the run when it is made.
struct PluginContext {
  std::string section;  ///< its section of the INI; owner of its factors and decisions
  Motion motion = Motion::planar;
  bool map_is_held = false;    ///< the run localizes in a map that it does not change
  std::string output_folder;   ///< an existing folder; empty in a run without outputs
  std::string title;           ///< of the run, for reports: the log's name
  std::string config_text;     ///< the INI of the run
  std::string run_folder;      ///< where the files of output_folder are in the end; need not exist yet
  std::string growing_folder;  ///< for what is shown of a map while it grows; need not exist, and is removed in the end
  std::function<void(const std::string&)>
      say;  ///< tells the user a sentence now; may be empty. For the engine's thread
};

/// The readers of the layers that need no plugin: the level, the place on earth, and what people corrected.
map::LayerRegistry layersOfNoPlugin();

/// The kinds of factors, payloads and layers that a map file may contain.
struct Kinds {
  graph::FactorRegistry factors = graph::FactorRegistry::withBuiltIns();
  map::PayloadRegistry payloads;
  map::LayerRegistry layers = layersOfNoPlugin();
};

enum class PluginKind { pose, measurement, output, extractor };

/// An MRPT run-time class that makes the plugins of one class. It has no state and needs no options to exist.
/// FactoryOf.h makes one of a plugin class; a plugin library registers its factories when it is loaded.
class PluginFactory : public mrpt::rtti::CObject {
  DEFINE_VIRTUAL_MRPT_OBJECT(PluginFactory)
 public:
  virtual PluginKind kind() const = 0;
  /// The name after "class =" in an INI.
  virtual std::string name() const = 0;
  /// One sentence for --list-plugins.
  virtual std::string summary() const = 0;
  virtual const std::vector<base::OptionSpec>& options() const = 0;
  /// Whether it lets others in, so that only the first INI or the command line may name it and set its options. In
  /// other INIs, which may come from anywhere, it is left out.
  virtual bool needsTrust() const { return false; }
  /// Registers the variables, factors, payloads and layers that the class's plugins put into a map, so that a map file
  /// can be read.
  virtual void registerKinds(Kinds& /*kinds*/) const {}
  /// Other sections that a plugin of `section` reads when it is made. When one of them changes during a run, the plugin
  /// is made anew, too.
  virtual std::vector<std::string> sectionsReadBy(const base::ConfigSection& /*section*/) const { return {}; }
};

/// make() reads the options from `section` and throws base::Error if they are invalid.
class PosePluginFactory : public PluginFactory {
  DEFINE_VIRTUAL_MRPT_OBJECT(PosePluginFactory)
 public:
  using Plugin = PosePlugin;
  PluginKind kind() const final { return PluginKind::pose; }
  virtual std::unique_ptr<PosePlugin> make(const base::ConfigSection& section, const PluginContext& context) const = 0;
};

class MeasurementPluginFactory : public PluginFactory {
  DEFINE_VIRTUAL_MRPT_OBJECT(MeasurementPluginFactory)
 public:
  using Plugin = MeasurementPlugin;
  PluginKind kind() const final { return PluginKind::measurement; }
  virtual std::unique_ptr<MeasurementPlugin> make(const base::ConfigSection& section,
                                                  const PluginContext& context) const = 0;
};

class OutputPluginFactory : public PluginFactory {
  DEFINE_VIRTUAL_MRPT_OBJECT(OutputPluginFactory)
 public:
  using Plugin = OutputPlugin;
  PluginKind kind() const final { return PluginKind::output; }
  virtual std::unique_ptr<OutputPlugin> make(const base::ConfigSection& section,
                                             const PluginContext& context) const = 0;
};

class ExtractorFactory : public PluginFactory {
  DEFINE_VIRTUAL_MRPT_OBJECT(ExtractorFactory)
 public:
  using Plugin = perception::Extractor;
  PluginKind kind() const final { return PluginKind::extractor; }
  virtual std::unique_ptr<perception::Extractor> make(const base::ConfigSection& section,
                                                      const PluginContext& context) const = 0;
};

/// Registers the four abstract factories with MRPT's run-time classes.
void registerFactoryBases();

/// Keys of a plugin's section that the engine reads itself.
inline const std::vector<std::string>& sectionKeysOfEngine() {
  static const std::vector<std::string> keys{"class"};
  return keys;
}

}  // namespace omnimapper::mapper
