#pragma once

#include <mrpt/obs/CObservation.h>

#include <string>
#include <vector>

#include "OddNumbers.h"

namespace omnimapper::fuzz {

using Observations = std::vector<mrpt::obs::CObservation::Ptr>;

/// The bytes of an uncompressed rawlog, without what MRPT refuses to write, such as two landmarks of one number.
std::string bytesOf(const Observations& log);

/// The bytes of an uncompressed rawlog, which is `log` with one to four things made wrong: values of one observation,
/// of some or of all of a sensor, stamps, labels, order, missing and repeated observations, and, now and
/// then, bytes. `log` stays as it is. The same dice give the same bytes.
std::string mutatedLog(const Observations& log, Dice& dice);

}  // namespace omnimapper::fuzz
