#pragma once

#include <omnimapper/base/Error.h>
#include <omnimapper/base/Progress.h>
#include <omnimapper/eval/Trajectory.h>
#include <omnimapper/surfaces/SurfaceSet.h>

#include <functional>
#include <string>
#include <vector>

namespace omnimapper::eval {

/// A plane that a single depth image shows, in the frame of the poses that were given.
struct SeenPlane {
  surfaces::Surface surface;            ///< its plane and outline; `seen` is what of it counts
  std::vector<Eigen::Vector3d> points;  ///< some of its points, as they were measured
};

/// What perception finds in one depth image alone.
struct View {
  std::string name;  ///< label and stamp of the image
  std::vector<SeenPlane> planes;
};

struct ViewOptions {
  base::Duration tolerance = base::durationFromSeconds(0.01);  ///< between the stamps of an image and of its pose
  base::Duration longest_gap{0};  ///< above zero: interpolate the poses over gaps up to this instead
  std::size_t most_views = 200;   ///< of more images every second, fourth, ... is taken
  double cell = 0.05;             ///< [m] of SeenPlane::surface.seen
  /// What is farther away or seen at a flatter angle does not count: there an error of depth is larger than what
  /// is to be judged. The same bounds as those of what the simulator calls seen.
  double max_range = 4;      ///< [m]
  double max_slant = 1.309;  ///< [rad] between ray and normal
  int pixels_of_point = 8;   ///< of so many columns and rows one pixel is kept as a point
};

struct LogViews {
  std::vector<View> views;
  std::size_t images = 0;  ///< depth images in the log
  std::size_t posed = 0;   ///< of these, with a pose
  base::ExitCode code = base::ExitCode::ok;
  std::string message;  ///< why the log was not read to its end; else empty
};

/// The planes of the depth images of a log, each image by itself, on the poses of the base in `trajectory`.
/// Throws Error(unreadable_input) for a log without depth images, or without one that has a pose, Error(interrupted) if
/// `stop` says so, and as source::openRawlogs().
LogViews readViews(const std::string& log, const Trajectory& trajectory, const ViewOptions& options,
                   base::Progress& progress, const std::function<bool()>& stop);

}  // namespace omnimapper::eval
