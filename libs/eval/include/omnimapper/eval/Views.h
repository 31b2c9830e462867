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
struct ViewPlane {
  surfaces::Surface surface;            ///< plane and outline; `seen` has the cells that count
  std::vector<Eigen::Vector3d> points;  ///< some of the plane's points, as they were measured
};

/// The planes that perception finds in one depth image alone.
struct View {
  std::string name;  ///< label and stamp of the image
  std::vector<ViewPlane> planes;
};

struct ViewOptions {
  base::Duration tolerance = base::durationFromSeconds(0.01);  ///< largest difference between stamps of image and pose
  /// If above zero, `tolerance` is not used: the poses are interpolated to the stamps of the images, over gaps up to
  /// this length.
  base::Duration longest_gap{0};
  std::size_t most_views = 200;  ///< if there are more images, every second, fourth, ... is used
  double cell = 0.05;            ///< [m] side of a cell of ViewPlane::surface.seen
  /// Points farther away or seen at a flatter angle do not count, because the error of depth there is larger than the
  /// errors of the map that are judged. The simulator has the same bounds for what counts as seen.
  double max_range = 4;      ///< [m]
  double max_slant = 1.309;  ///< [rad] largest angle between ray and normal
  int pixels_of_point = 8;   ///< of each square of this many columns and rows, one pixel is kept as a point
};

struct LogViews {
  std::vector<View> views;
  std::size_t images = 0;  ///< depth images in the log
  std::size_t posed = 0;   ///< depth images that have a pose
  base::ExitCode code = base::ExitCode::ok;
  std::string message;  ///< why the log was not read to its end; empty if it was read to its end
};

/// The planes of the depth images of a log, each image by itself, placed by the poses of the base in `trajectory`.
/// Throws Error(unreadable_input) if the log has no depth images or none of them has a pose, Error(interrupted) if
/// `stop` returns true, and as source::openLogs() does.
LogViews readViews(const std::string& log, const Trajectory& trajectory, const ViewOptions& options,
                   base::Progress& progress, const std::function<bool()>& stop);

}  // namespace omnimapper::eval
