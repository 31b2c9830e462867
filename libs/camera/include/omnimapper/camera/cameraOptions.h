#pragma once

#include <omnimapper/base/OptionTable.h>

namespace omnimapper::camera {

/// Adds the keys of the intrinsics and lenses of a depth camera and its colour camera to the table of a struct with the
/// members depth_fx to depth_k3 and picture_fx to picture_k3, as CameraCalibrationOptions has them.
template <class Options>
void addIntrinsics(base::OptionTable<Options>& table) {
  const base::Range focal{1, 1e5}, centre{-1e5, 1e5}, lens{-1000, 1000};
  table.number("depth_fx_px", &Options::depth_fx, focal, "Horizontal focal length of the depth camera.")
      .number("depth_fy_px", &Options::depth_fy, focal, "Vertical focal length of the depth camera.")
      .number("depth_cx_px", &Options::depth_cx, centre, "Column of the depth camera's optical axis.")
      .number("depth_cy_px", &Options::depth_cy, centre, "Row of the depth camera's optical axis.")
      .number("depth_k1", &Options::depth_k1, lens,
              "First radial distortion coefficient of the depth camera's lens, in OpenCV's model.")
      .number("depth_k2", &Options::depth_k2, lens,
              "Second radial distortion coefficient of the depth camera's lens, in OpenCV's model.")
      .number("depth_p1", &Options::depth_p1, lens,
              "First tangential distortion coefficient of the depth camera's lens, in OpenCV's model.")
      .number("depth_p2", &Options::depth_p2, lens,
              "Second tangential distortion coefficient of the depth camera's lens, in OpenCV's model.")
      .number("depth_k3", &Options::depth_k3, lens,
              "Third radial distortion coefficient of the depth camera's lens, in OpenCV's model.")
      .number("picture_fx_px", &Options::picture_fx, focal, "Horizontal focal length of the colour camera.")
      .number("picture_fy_px", &Options::picture_fy, focal, "Vertical focal length of the colour camera.")
      .number("picture_cx_px", &Options::picture_cx, centre, "Column of the colour camera's optical axis.")
      .number("picture_cy_px", &Options::picture_cy, centre, "Row of the colour camera's optical axis.")
      .number("picture_k1", &Options::picture_k1, lens,
              "First radial distortion coefficient of the colour camera's lens, in OpenCV's model.")
      .number("picture_k2", &Options::picture_k2, lens,
              "Second radial distortion coefficient of the colour camera's lens, in OpenCV's model.")
      .number("picture_p1", &Options::picture_p1, lens,
              "First tangential distortion coefficient of the colour camera's lens, in OpenCV's model.")
      .number("picture_p2", &Options::picture_p2, lens,
              "Second tangential distortion coefficient of the colour camera's lens, in OpenCV's model.")
      .number("picture_k3", &Options::picture_k3, lens,
              "Third radial distortion coefficient of the colour camera's lens, in OpenCV's model.");
}

/// Adds the keys of the pose of the colour camera in the depth camera's frame, as MRPT's relativePoseIntensityWRTDepth
/// has it: the members picture_x to picture_roll.
template <class Options>
void addPicturePose(base::OptionTable<Options>& table) {
  const base::Range place{-10, 10};
  table
      .number("picture_x_m", &Options::picture_x, place,
              "Forward position of the colour camera in the depth camera's frame (x forward, y left, z up).")
      .number("picture_y_m", &Options::picture_y, place,
              "Leftward position of the colour camera in the depth camera's frame (x forward, y left, z up).")
      .number("picture_z_m", &Options::picture_z, place,
              "Upward position of the colour camera in the depth camera's frame (x forward, y left, z up).")
      .number("picture_yaw_deg", &Options::picture_yaw, {},
              "Rotation about the depth camera's z axis (its frame: x forward, y left, z up) of the colour camera's "
              "optical frame (x right, y down, z ahead).")
      .number("picture_pitch_deg", &Options::picture_pitch, {},
              "Rotation about the depth camera's y axis (its frame: x forward, y left, z up) of the colour camera's "
              "optical frame (x right, y down, z ahead).")
      .number("picture_roll_deg", &Options::picture_roll, {},
              "Rotation about the depth camera's x axis (its frame: x forward, y left, z up) of the colour camera's "
              "optical frame (x right, y down, z ahead).");
}

}  // namespace omnimapper::camera
