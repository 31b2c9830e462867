#pragma once

#include <mrpt/obs/CObservation2DRangeScan.h>

#include <map>
#include <string>

#include "CarmenLine.h"

namespace omnimapper::source {

/// Converts scans of CARMEN to MRPT's. Beams and mounting come from the log's PARAM lines if the scan's line does not
/// state them.
class CarmenLasers {
 public:
  void set(const CarmenParameter& parameter) { parameters_[parameter.name] = parameter.value; }

  /// The scan, with label and stamp.
  mrpt::obs::CObservation2DRangeScan::Ptr scan(const CarmenScanLine& line, base::Stamp stamp) const;

 private:
  double number(const std::string& name, double otherwise) const;
  CarmenBeams beamsOf(const CarmenScanLine& line) const;
  mrpt::math::TPose2D baseFromLaser(const CarmenScanLine& line) const;

  std::map<std::string, std::string> parameters_;
};

}  // namespace omnimapper::source
