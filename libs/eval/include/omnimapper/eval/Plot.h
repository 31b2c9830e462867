#pragma once

#include <omnimapper/eval/AbsoluteTrajectoryError.h>

#include <ostream>
#include <string>
#include <vector>

namespace omnimapper::eval {

/// An SVG of the trajectories, seen from above: the whole reference in grey, and the estimate (already aligned)
/// coloured by its distance to the reference [m]. The axes are in metres with the same scale. Has a colour bar and a
/// legend.
void plotTrajectory(std::ostream& out, const AbsoluteTrajectoryError& error, const Trajectory& reference,
                    const std::string& title);

/// An SVG with two curves over the time since the first stamp [s], one below the other: the translation errors [m], and
/// the rotation errors [rad], which are drawn in degrees. Each curve has a line at its mean.
void plotErrors(std::ostream& out, const std::vector<base::Stamp>& stamps,
                const std::vector<double>& translation_errors, const std::vector<double>& rotation_errors,
                const std::string& title);

}  // namespace omnimapper::eval
