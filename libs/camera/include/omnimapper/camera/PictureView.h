#pragma once

#include <mrpt/img/CImage.h>
#include <mrpt/img/TCamera.h>
#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/poses/CPose3D.h>

#include <Eigen/Core>
#include <optional>
#include <string>

namespace omnimapper::camera {

/// The picture of an observation, and the camera that took it.
struct Picture {
  const mrpt::img::CImage* image;  ///< owned by the observation; null if there is no picture or it has no pixels
  const mrpt::img::TCamera* camera;
  mrpt::poses::CPose3D pose;  ///< of the optical frame (x right, y down, z forward) on the base
};

/// Whether the observation comes from a camera, or from a range camera with a picture. The picture may be in a file.
bool bringsPicture(const mrpt::obs::CObservation& observation);

/// The picture of an observation. The picture of a range camera is returned with its own calibration. If it has the
/// same view as the depth image, it is returned with the calibration of the depth image instead, because its own
/// calibration may be missing. Throws Error(missing_images) for a picture in a file that does not exist.
Picture pictureOf(const mrpt::obs::CObservation& observation);

/// Whether each pixel of a range camera's picture shows what the same pixel of the depth image shows: size, pose, focal
/// lengths and centre are the same. A picture whose camera is not calibrated (focal length 0) counts as taken with the
/// intrinsics of the depth image.
bool isPictureOfDepthView(const mrpt::obs::CObservation3DRangeScan& scan);

/// Column and row [px] at which a camera with its lens shows a point [m]. The point is given in the camera's frame (x
/// forward, y left, z up). The centre of a pixel has whole numbers. None if the point is not in front of the camera or
/// the camera has no valid calibration.
std::optional<Eigen::Vector2d> pixelOf(const mrpt::img::TCamera& camera, const Eigen::Vector3d& point_in_sensor);

/// Throws Error(missing_images), which says that the image `what` ("depth" or "colour") of the sensor `label` is in
/// `file`, which was not loaded.
[[noreturn]] void refuseMissing(const std::string& label, const std::string& what, const std::string& file);

}  // namespace omnimapper::camera
