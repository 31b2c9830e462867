#pragma once

#include <omnimapper/base/Config.h>
#include <omnimapper/map/Map.h>
#include <omnimapper/source/SourceReport.h>

#include <string>
#include <vector>

namespace omnimapper::mapper {

/// Sensor labels that an INI names and that no observation of the run had: a sentence for each, with the existing
/// labels. `sections` are those of plugins and sensors. Checked are their keys `label`, `labels` and `odometry_label`,
/// [mapper] reference_sensor and [source] labels. The labels of derived observations are taken from the newest session
/// of `map`.
std::vector<std::string> unknownLabels(const base::Config& config, const std::vector<std::string>& sections,
                                       const source::SourceReport& report, const map::Map& map);

}  // namespace omnimapper::mapper
