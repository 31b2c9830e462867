#pragma once

#include <omnimapper/base/Config.h>
#include <omnimapper/map/Map.h>
#include <omnimapper/source/SourceReport.h>

#include <string>
#include <vector>

namespace omnimapper::mapper {

/// Sensor labels that an INI names and that no observation of the run had, a sentence each with the labels that there
/// are. `sections` are those of plugins and sensors; their keys `label`, `labels` and `odometry_label` count, [mapper]
/// reference_sensor and [source] labels. `map` knows the labels of what extractors made: only its newest session
/// counts.
std::vector<std::string> unknownLabels(const base::Config& config, const std::vector<std::string>& sections,
                                       const source::SourceReport& report, const map::Map& map);

}  // namespace omnimapper::mapper
