#pragma once

#include <mrpt/config/CConfigFileBase.h>
#include <omnimapper/base/OptionTable.h>
#include <omnimapper/drivers/KinectCalibration.h>

#include <optional>
#include <string>

namespace omnimapper::drivers {

/// The section of a KinectSensor in an INI file. Keys that MRPT's drivers have in common keep MRPT's names: pose_x to
/// pose_z [m], pose_yaw to pose_roll [deg], grab_image, grab_IMU, device_number.
struct KinectOptions : KinectCalibration {
  /// Camera frame of the depth image. none: the frame of the depth camera (unregistered). ours: that of the colour
  /// camera, registered with this section's calibration; if there are no pictures (grab_image = false), the same as
  /// `none`. device: that of the colour camera, registered with the calibration inside the device by libfreenect.
  enum class Registration { none, ours, device };
  enum class Led { as_it_is, off, green, red, yellow, blink_green, blink_red_yellow };

  int device_number = 0;  ///< counted from 0 in the order of the USB bus
  std::string serial;     ///< serial number of the camera; empty: device_number selects the camera
  /// base_from_sensor, where the sensor is the depth camera with x forward, y left and z up. In [m] and, unlike
  /// elsewhere, [deg].
  double pose_x = 0, pose_y = 0, pose_z = 0, pose_yaw = 0, pose_pitch = 0, pose_roll = 0;
  bool grab_image = true, grab_imu = true;
  double imu_rate = 10;  ///< [1/s]
  Registration registration = Registration::ours;
  std::optional<double> tilt;  ///< [rad] of the optical axis above the horizon; empty: the motor is not moved
  Led led = Led::as_it_is;
  double max_range = 10;  ///< [m] pixels with larger depths count as having no depth
  double pairing = 0.02;  ///< [s] largest time difference between a depth image and its picture
  double silence = 3;     ///< [s] without a depth image, after which the device counts as lost

  /// Whether the USB device in the foot is needed. It has the motor, the lamp and the accelerometer, and is separate
  /// from the cameras on the USB bus.
  bool usesMotor() const { return tilt || led != Led::as_it_is || grab_imu; }
  mrpt::poses::CPose3D baseFromSensor() const;

  static const base::OptionTable<KinectOptions>& table();
  /// Reads the section of an INI that is given to MRPT's drivers. If the section has the focal lengths and the centre
  /// of a camera, the coefficients of that camera's lens which the section does not have are 0, so that no part of
  /// another device's calibration is mixed in. Throws Error unknown_key, wrong_type or out_of_range; out_of_range also
  /// if a camera has only some of its two focal lengths and two coordinates of the centre.
  static KinectOptions read(const mrpt::config::CConfigFileBase& ini, const std::string& section);
};

}  // namespace omnimapper::drivers
