#pragma once

#include <mrpt/obs/CObservation2DRangeScan.h>

#include <map>
#include <string>

#include "CarmenLine.h"

namespace omnimapper::source {

/// Makes MRPT scans of CARMEN's, with beams and mounting from the log's PARAM lines where the scan does not say them.
class CarmenLasers {
 public:
  void set(const CarmenParameter& parameter) { parameters_[parameter.name] = parameter.value; }

  /// Label and stamp included.
  mrpt::obs::CObservation2DRangeScan::Ptr scan(const CarmenScanLine& line, base::Stamp stamp) const;

 private:
  double number(const std::string& name, double otherwise) const;
  CarmenBeams beamsOf(const CarmenScanLine& line) const;
  mrpt::math::TPose2D baseFromLaser(const CarmenScanLine& line) const;

  std::map<std::string, std::string> parameters_;
};

}  // namespace omnimapper::source
