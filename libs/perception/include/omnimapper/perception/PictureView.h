#pragma once

#include <mrpt/img/CImage.h>
#include <mrpt/img/TCamera.h>
#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/poses/CPose3D.h>

#include <Eigen/Core>
#include <optional>
#include <string>

namespace omnimapper::perception {

/// The picture that an observation brings, and the camera that took it.
struct Picture {
  const mrpt::img::CImage* image;  ///< of the observation; none if it brings no picture, or one without pixels
  const mrpt::img::TCamera* camera;
  mrpt::poses::CPose3D pose;  ///< of the optical frame (x right, y down, z forward) on the base
};

/// Whether it is of a camera, or of a range camera with a picture, which may be in a file.
bool bringsPicture(const mrpt::obs::CObservation& observation);

/// Of a range camera that with the calibration of the picture, or of the depth image where both have one view, since
/// that of the picture may be missing then. Throws Error(missing_images) for a picture in a file that is not there.
Picture pictureOf(const mrpt::obs::CObservation& observation);

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
