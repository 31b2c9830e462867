#pragma once

#include <mrpt/obs/CObservation.h>
#include <omnimapper/mapper/PluginRegistry.h>

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace omnimapper::mapper {

/// Keeps the first observation of each sensor and class of a log, to try extractors that the INI does not name.
class SensorSamples {
 public:
  void add(const mrpt::obs::CObservation::ConstPtr& observation);

  /// Whether one of these extractors derives observations that `plugin` wants.
  bool isFedBy(const std::vector<Named<perception::Extractor>>& extractors, const MeasurementPlugin& plugin) const;
  /// A sentence that names the extractor classes that would, with default options, derive observations that `plugin`
  /// wants; empty if there are none.
  std::string extractorsFor(const MeasurementPlugin& plugin) const;

 private:
  std::map<std::pair<std::string, const void*>, mrpt::obs::CObservation::ConstPtr> samples_;  // by label and class
};

}  // namespace omnimapper::mapper
