#pragma once

#include <omnimapper/eval/AbsoluteTrajectoryError.h>

#include <ostream>
#include <string>
#include <vector>

namespace omnimapper::eval {

/// SVG, seen from above: the whole reference in grey, the estimate (already aligned) coloured by its distance to the
/// reference [m], axes in metres of equal scale, colour bar and legend.
void plotTrajectory(std::ostream& out, const AbsoluteTrajectoryError& error, const Trajectory& reference,
                    const std::string& title);

/// SVG of two curves over time since the first stamp [s], one below the other: translation [m] and rotation errors,
/// drawn in degrees, each with its mean.
void plotErrors(std::ostream& out, const std::vector<base::Stamp>& stamps,
                const std::vector<double>& translation_errors, const std::vector<double>& rotation_errors,
                const std::string& title);

}  // namespace omnimapper::eval
