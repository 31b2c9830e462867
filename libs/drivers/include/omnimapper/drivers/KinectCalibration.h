#pragma once

#include <mrpt/img/TCamera.h>
#include <mrpt/poses/CPose3D.h>

namespace omnimapper::drivers {

/// Calibration of the two cameras of a Kinect of the first generation (Xbox 360), and of its raw depths. The default
/// focal lengths, centres, lenses and raw depths are those of one device, as N. Burrus published them ("Kinect
/// calibration", nicolas.burrus.name, 2010; also openkinect.org, "Imaging Information"). Another device differs by some
/// percent of the depth and some pixels. By default the colour camera is 2.5 cm to the right of the depth camera,
/// without rotation, as in the frames of ROS's openni_launch. omnimapper-calibrate estimates all these numbers.
struct KinectCalibration {
  /// 1 / depth [1/m] = inverse_depth_at_zero + inverse_depth_step * raw, for raw from 0 to 2046.
  double inverse_depth_at_zero = 3.3309495161, inverse_depth_step = -0.0030711016;

  double depth_fx = 594.21434211923247, depth_fy = 591.04053696870778;  ///< [px]
  double depth_cx = 339.30780975300314, depth_cy = 242.73913761751615;  ///< [px]
  /// Lens of the depth camera, in the model of OpenCV and of MRPT's plumb_bob.
  double depth_k1 = -0.26386489753128833, depth_k2 = 0.99966832163729757, depth_p1 = -0.00076275862143610667,
         depth_p2 = 0.0050350940090814270, depth_k3 = -1.3053628089976321;

  double picture_fx = 529.21508098293293, picture_fy = 525.56393630057437;  ///< [px]
  double picture_cx = 328.94272028759258, picture_cy = 267.48068171871557;  ///< [px]
  /// Lens of the colour camera.
  double picture_k1 = 0.26451622333009589, picture_k2 = -0.83990749424620825, picture_p1 = -0.0019922302173693159,
         picture_p2 = 0.0014371995932897616, picture_k3 = 0.91192465078713847;

  /// depth_from_picture, as in MRPT's relativePoseIntensityWRTDepth: position [m], then rotations [rad] about z, y and
  /// x. The depth camera's frame has x forward, y left and z up; the picture's frame is optical (x right, y down, z
  /// forward).
  double picture_x = 0, picture_y = -0.025, picture_z = 0;
  double picture_yaw = -1.5707963267948966, picture_pitch = 0, picture_roll = -1.5707963267948966;

  /// Depth along the optical axis [m] that a raw value of 11 bits stands for. 0 if the raw value means no depth: 2047,
  /// and values that the calibration maps to infinity or behind the camera.
  double depthOf(int raw) const;
  /// The raw value whose inverse depth is nearest to 1 / `depth` (`depth` in [m]); 2047 if no value from 0 to 2046
  /// corresponds to this depth.
  int rawOf(double depth) const;

  /// Both cameras have 640 x 480 pixels.
  mrpt::img::TCamera depthCamera() const;
  mrpt::img::TCamera pictureCamera() const;
  mrpt::poses::CPose3D depthFromPicture() const;
};

inline constexpr int kKinectWidth = 640, kKinectHeight = 480;  ///< [px] of either camera
inline constexpr int kKinectNoDepth = 2047;                    ///< the raw value that means no depth

}  // namespace omnimapper::drivers
