#pragma once

#include <mrpt/obs/CObservation.h>
#include <omnimapper/base/Stamp.h>
#include <omnimapper/plugin/View.h>

#include <map>
#include <string>

namespace omnimapper::mapper {

/// Refuses observations that nothing can be made of, and counts them.
class InputFilter {
 public:
  /// Whether it has a stamp, of its own among those of its class and label that came just before, and a finite sensor
  /// pose.
  bool accepts(const mrpt::obs::CObservation& observation, RunCounts& counts);

 private:
  std::map<const mrpt::rtti::TRuntimeClassId*, std::map<std::string, base::Stamp>> last_;  // by class and label
};

}  // namespace omnimapper::mapper
