#pragma once

#include <mrpt/obs/CObservation.h>

#include <string>
#include <vector>

#include "OddNumbers.h"

namespace omnimapper::fuzz {

using Observations = std::vector<mrpt::obs::CObservation::Ptr>;

/// The bytes of an uncompressed rawlog. Observations that MRPT refuses to write, for example because two landmarks have
/// the same number, are left out.
std::string bytesOf(const Observations& log);

/// The bytes of an uncompressed rawlog with a copy of `log` that has one to four errors: values in one, some or all
/// observations of a sensor, stamps, labels, order, missing or repeated observations, and sometimes bytes. The same
/// dice give the same bytes.
std::string mutatedLog(const Observations& log, Dice& dice);

}  // namespace omnimapper::fuzz
