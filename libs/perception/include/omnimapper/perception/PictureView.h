#pragma once

#include <mrpt/obs/CObservation3DRangeScan.h>

#include <Eigen/Core>
#include <optional>
#include <string>

namespace omnimapper::perception {

/// Whether the picture of a range camera shows in each pixel what the depth image has there: the size is the same, the
/// place and turn, the focal lengths and the centre. A picture whose camera is not calibrated (focal length 0) counts
/// as taken with the depth image's.
bool isPictureOfDepthView(const mrpt::obs::CObservation3DRangeScan& scan);

/// Column and row [px] where a camera shows a point of its frame (x forward, y left, z up) [m], by its lens; the centre
/// of a pixel has whole numbers. None for what is not before it, and of a camera without a calibration to be used.
std::optional<Eigen::Vector2d> pixelOf(const mrpt::img::TCamera& camera, const Eigen::Vector3d& point_in_sensor);

/// Throws Error(missing_images): an image ("depth", "colour") of that sensor is in a file that was not loaded.
[[noreturn]] void refuseMissing(const std::string& label, const std::string& what, const std::string& file);

}  // namespace omnimapper::perception
