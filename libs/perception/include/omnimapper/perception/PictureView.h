#pragma once

#include <mrpt/img/CImage.h>
#include <mrpt/img/TCamera.h>
#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/poses/CPose3D.h>

#include <Eigen/Core>
#include <optional>
#include <string>

namespace omnimapper::perception {

/// The picture of an observation, and the camera that took it.
struct Picture {
  const mrpt::img::CImage* image;  ///< owned by the observation; null if it has no picture, or one without pixels
  const mrpt::img::TCamera* camera;
  mrpt::poses::CPose3D pose;  ///< of the optical frame (x right, y down, z forward) on the base
};

/// Whether the observation is of a camera, or of a range camera with a picture; the picture may be in a file.
bool bringsPicture(const mrpt::obs::CObservation& observation);

/// The picture of an observation. The picture of a range camera comes with its own calibration. If it has the same
/// view as the depth image it comes with the calibration of that, because its own may be missing. Throws
/// Error(missing_images) for a picture in a file that does not exist.
Picture pictureOf(const mrpt::obs::CObservation& observation);

/// Whether each pixel of a range camera's picture shows what the same pixel of the depth image shows: size, pose, focal
/// lengths and centre are the same. A picture whose camera is not calibrated (focal length 0) counts as taken with the
/// intrinsics of the depth image.
bool isPictureOfDepthView(const mrpt::obs::CObservation3DRangeScan& scan);

/// Column and row [px] at which a camera with its lens shows a point [m], given in its frame (x forward, y left, z up);
/// the centre of a pixel has whole numbers. None for a point that is not in front of the camera, and for a camera
/// without a valid calibration.
std::optional<Eigen::Vector2d> pixelOf(const mrpt::img::TCamera& camera, const Eigen::Vector3d& point_in_sensor);

/// Throws Error(missing_images): an image ("depth", "colour") of that sensor is in a file that was not loaded.
[[noreturn]] void refuseMissing(const std::string& label, const std::string& what, const std::string& file);

}  // namespace omnimapper::perception
