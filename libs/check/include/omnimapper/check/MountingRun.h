#pragma once

#include <omnimapper/base/Config.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/base/Progress.h>

#include <functional>
#include <string>
#include <vector>

namespace omnimapper::check {

struct MountingResult {
  base::ExitCode code = base::ExitCode::ok;
  std::string text;  ///< one screen: what was measured and how well, what was not and why, what has two causes
  std::vector<std::string> warnings;
};

/// Measures from logs (several are merged by stamp) how the sensors of a robot are mounted: yaw, sense, sweep and place
/// of lasers, and their pitch where beams meet the floor; yaw, pitch, roll, height, depth scale, focal length and kind
/// of images of depth cameras; the clocks of all. What differs from what the log and `config` (which may be empty)
/// declare is applied, and the log is read and measured once more. Writes to `output_folder` mounting.ini, to be given
/// after the INIs of `config`, with the standard deviation of each value, and report.txt. A value that has two causes
/// is written as a comment.
///
/// The exit code is that of the source's report if the log is damaged, doubtful_input if something has two causes or
/// the log still contradicts what it and mounting.ini declare, else ok. Throws Error(nothing_to_map) if nothing can be
/// measured, and Error(interrupted) if `stop` returns true; then nothing is written. Throws base::Error also as
/// source::openLogs() and base::writeFile() do.
MountingResult runMounting(const std::vector<std::string>& logs, const base::Config& config,
                           const std::string& output_folder, base::Progress& progress,
                           const std::function<bool()>& stop);

}  // namespace omnimapper::check
