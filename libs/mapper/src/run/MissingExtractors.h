#pragma once

#include <mrpt/obs/CObservation.h>
#include <omnimapper/plugin/MeasurementPlugin.h>

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace omnimapper::mapper {

/// The first observation of each sensor and class in a log: what extractors that nobody named would make of it.
class SensorSamples {
 public:
  void add(const mrpt::obs::CObservation::ConstPtr& observation);

  /// A sentence that names the extractor classes, with their default options, that would give `plugin` something to
  /// work on; empty if there is none.
  std::string extractorsFor(const MeasurementPlugin& plugin) const;

 private:
  std::map<std::pair<std::string, const void*>, mrpt::obs::CObservation::ConstPtr> samples_;  // by label and class
};

}  // namespace omnimapper::mapper
