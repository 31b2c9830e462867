#pragma once

#include <mrpt/obs/CObservation.h>
#include <omnimapper/base/Stamp.h>
#include <omnimapper/plugin/View.h>

#include <map>
#include <string>

namespace omnimapper::mapper {

/// Refuses unusable observations and counts them.
class InputFilter {
 public:
  /// Whether the observation has a valid stamp, which differs from that of the previous one of its class and label, and
  /// a finite sensor pose.
  bool accepts(const mrpt::obs::CObservation& observation, RunCounts& counts);

 private:
  std::map<const mrpt::rtti::TRuntimeClassId*, std::map<std::string, base::Stamp>> last_;  // by class and label
};

}  // namespace omnimapper::mapper
