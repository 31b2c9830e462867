#pragma once

#include <omnimapper/geometry/Se3.h>

#include <string>

#include "EvalVerbs.h"

namespace omnimapper::evaluation {

/// The motion from the frame of a map to the true one, by the alignment, tolerance and interpolation of the arguments:
/// its trajectory (TUM) is aligned to the true one. Throws base::Error(command_line) for the alignment sim3, and
/// base::Error(unreadable_input) naming the file if a trajectory is missing or damaged.
geometry::Se3 trueFromMap(const Arguments& arguments, const std::string& trajectory, const std::string& truth);

}  // namespace omnimapper::evaluation
