#include "run/PluginDifference.h"

#include <omnimapper/base/IniDifferences.h>
#include <omnimapper/base/OptionTable.h>
#include <omnimapper/mapper/EngineOptions.h>

#include <algorithm>
#include <set>

namespace omnimapper::mapper {

namespace {

using Names = std::vector<std::string>;

PluginSections sectionsOf(const base::Config& config, const Names& more_outputs) {
  return {config.section("mapper").read<EngineOptions>().pose_plugins,
          config.section("perception").read<PerceptionOptions>().extractors, measurementSections(config),
          outputSections(config, more_outputs).made};
}

// "trigger" of "[trigger] distance_m (0.2, was 0.5)".
std::string sectionOf(const std::string& difference) {
  return difference.substr(1, difference.find(']') - 1);
}

bool isList(const std::string& difference) {
  for (const char* key : {"[mapper] pose_plugins", "[mapper] measurement_plugins", "[mapper] output_plugins",
                          "[mapper] default_plugins", "[mapper] plugin_libraries", "[perception] extractors"})
    if (difference.rfind(std::string(key) + " ", 0) == 0) return true;
  return false;
}

// Adds to `difference` what changes in one of the lists; returns the sections to make.
Names compare(const Names& before, const Names& now, const std::set<std::string>& other_settings,
              PluginDifference& difference) {
  const auto has = [](const Names& list, const std::string& name) {
    return std::count(list.begin(), list.end(), name) > 0;
  };
  for (const auto& section : before)
    if (!has(now, section)) difference.removed.push_back(section);
  Names to_make;
  for (const auto& section : now) {
    if (has(before, section) && other_settings.count(section) == 0) continue;
    (has(before, section) ? difference.renewed : difference.added).push_back(section);
    to_make.push_back(section);
  }
  const bool has_same = std::is_permutation(before.begin(), before.end(), now.begin(), now.end());
  difference.is_reordered = difference.is_reordered || (has_same && before != now);
  return to_make;
}

// Adds the plugins that read one of these sections beside their own.
void addReaders(PluginKind kind, const Names& plugins, const base::Config& config, const Names& kept,
                std::set<std::string>& changed) {
  for (const auto& name : plugins) {
    if (std::count(kept.begin(), kept.end(), name) > 0) continue;
    for (const auto& read : factoryOfSection(kind, name, config)->sectionsReadBy(config.section(name)))
      if (changed.count(read) > 0) changed.insert(name);
  }
}

void append(std::string& text, const std::string& what, const Names& sections) {
  if (!sections.empty()) text += (text.empty() ? "" : "; ") + what + " " + base::option_text::format(sections);
}

}  // namespace

std::string PluginDifference::sentence() const {
  std::string text;
  append(text, "added", added);
  append(text, "removed", removed);
  append(text, "gave other settings to", renewed);
  if (is_reordered) text += std::string(text.empty() ? "" : "; ") + "changed the order";
  return text;
}

PluginDifference differenceOf(const base::Config& before, const base::Config& now, const Names& more_outputs,
                              PluginContext context, const Names& kept) {
  Names more = more_outputs;
  more.insert(more.end(), kept.begin(), kept.end());
  const auto of_before = sectionsOf(before, more_outputs), of_now = sectionsOf(now, more);
  std::set<std::string> plugins, other_settings;
  for (const auto* list : {&of_now.pose, &of_now.extractors, &of_now.measurement, &of_now.output, &of_before.pose,
                           &of_before.extractors, &of_before.measurement, &of_before.output})
    plugins.insert(list->begin(), list->end());
  PluginDifference difference;
  const auto unlisted = now.switchedOffPlugins();
  for (const auto& each : base::iniDifferences(now.text(), before.text())) {
    const std::string section = sectionOf(each);
    if (plugins.count(section) > 0 && std::count(kept.begin(), kept.end(), section) == 0) {
      other_settings.insert(section);
    } else if (!isList(each) &&
               (plugins.count(section) > 0 || std::count(unlisted.begin(), unlisted.end(), section) == 0)) {
      difference.unused.push_back(each);
    }
  }
  const auto libraries = [](const base::Config& config) {
    return config.section("mapper").read<EngineOptions>().plugin_libraries;
  };
  if (libraries(now) != libraries(before)) {
    loadPluginLibraries(now);
    difference.change.layers = registeredKinds().layers;
  }
  addReaders(PluginKind::pose, of_now.pose, now, kept, other_settings);
  addReaders(PluginKind::extractor, of_now.extractors, now, kept, other_settings);
  addReaders(PluginKind::measurement, of_now.measurement, now, kept, other_settings);
  addReaders(PluginKind::output, of_now.output, now, kept, other_settings);
  PluginSections to_make;
  to_make.pose = compare(of_before.pose, of_now.pose, other_settings, difference);
  to_make.extractors = compare(of_before.extractors, of_now.extractors, other_settings, difference);
  to_make.measurement = compare(of_before.measurement, of_now.measurement, other_settings, difference);
  to_make.output = compare(of_before.output, of_now.output, other_settings, difference);
  context.config_text = now.text();
  difference.change.added = makePlugins(to_make, now, context);
  difference.change.removed = difference.removed;
  difference.change.removed.insert(difference.change.removed.end(), difference.renewed.begin(),
                                   difference.renewed.end());
  difference.change.order = of_now;
  return difference;
}

}  // namespace omnimapper::mapper
