#include <omnimapper/check/fittingInis.h>
#include <omnimapper/mapper/EngineOptions.h>

#include <algorithm>
#include <utility>

#include "IniFit.h"
#include "ShippedInis.h"

namespace omnimapper::check {

PluginLists PluginLists::read(const base::Config& config) {
  const auto options = config.section("mapper").read<mapper::EngineOptions>();
  const auto extractors = config.section("perception").read<mapper::PerceptionOptions>().extractors;
  std::string text;
  bool is_fallback = false;  // the section may be of another plugin, whose keys are not known here
  if (config.section("odometry").find("fallback", text)) base::option_text::parse(text, is_fallback);
  return {options.pose_plugins, extractors, options.measurement_plugins, is_fallback, options.sensors};
}

std::vector<FittingIni> fittingInis(const LogFacts& facts) {
  std::vector<std::pair<int, FittingIni>> found;
  for (const auto& ini : kShippedInis) {
    const std::string file(ini.file), text(ini.text);
    for (const auto& fit : fitsOf(text, file)) {
      if (!fit.fits(facts)) continue;
      const auto plugins = PluginLists::read(base::Config::fromText(text, file));
      found.push_back({fit.place, {file, fit.what, plugins, fit.needs_settings, fit.is_a_guess}});
    }
  }
  std::stable_sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<FittingIni> inis;
  for (auto& [place, ini] : found) inis.push_back(std::move(ini));
  return inis;
}

}  // namespace omnimapper::check
