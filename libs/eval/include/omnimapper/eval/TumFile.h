#pragma once

#include <omnimapper/eval/Trajectory.h>

#include <string>

namespace omnimapper::eval {

/// Text files of trajectories with one pose a line, in any order. '#' starts a comment; blanks or tabs separate the
/// columns. Stamps are Unix seconds, read and written exactly to the tick. All readers throw Error(unreadable_input).
/// The error names file:line if a column is missing, a text is not a finite number, a quaternion is not of unit length
/// (to 1 %) or a stamp occurs twice. A file without poses is an error, too.

/// TUM RGB-D format: stamp x y z [m] qx qy qz qw.
Trajectory readTum(const std::string& path);

/// Ground truth of MRPT's simulated graph-SLAM logs (*.GT.txt): stamp x y [m] yaw [rad].
Trajectory readMrptGroundTruth(const std::string& path);

/// Reads either format, detected by the number of columns in the first line that holds a pose.
Trajectory readTrajectory(const std::string& path);

/// Writes the TUM RGB-D format. An existing file is replaced as a whole (base::writeFile()).
void writeTum(const std::string& path, const Trajectory& trajectory);

}  // namespace omnimapper::eval
