#pragma once

#include <omnimapper/source/ObservationSource.h>
#include <omnimapper/source/RawlogWriter.h>

#include <cstddef>

#include "ImportArguments.h"

/// Copies the log into the rawlog as the arguments say, and shows its progress on a terminal. Returns the number of
/// observations with a true pose. Throws Error(unreadable_input) if there is nothing to copy, or with --poses no true
/// pose, and Error(interrupted) after Ctrl-C.
std::size_t copyLog(omnimapper::source::ObservationSource& log, const Arguments& arguments,
                    omnimapper::source::RawlogWriter& rawlog);
