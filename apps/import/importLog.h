#pragma once

#include <omnimapper/base/Error.h>

#include "ImportArguments.h"

/// Reads the log, writes a rawlog and prints a summary. For an `output` X.rawlog, the ground truth is written to
/// X.truth.tum if the log has one, and external images are written into the folder X_Images.
omnimapper::base::ExitCode importLog(const Arguments& arguments);
