#pragma once

#include <mrpt/config/CConfigFileBase.h>
#include <omnimapper/base/OptionTable.h>
#include <omnimapper/drivers/KinectCalibration.h>

#include <optional>
#include <string>

namespace omnimapper::drivers {

/// Section of a KinectSensor in an INI file. Keys that MRPT's drivers have in common keep MRPT's names: pose_x to
/// pose_z [m], pose_yaw to pose_roll [deg], grab_image, grab_IMU, device_number.
struct KinectOptions : KinectCalibration {
  /// Camera frame of the depth image. none: the depth camera's, unregistered; ours: the colour camera's, registered
  /// with this section's calibration; device: the same, by the calibration inside the device and libfreenect.
  enum class Registration { none, ours, device };
  enum class Led { as_it_is, off, green, red, yellow, blink_green, blink_red_yellow };

  int device_number = 0;  ///< counted from 0 in the order of the USB bus
  std::string serial;     ///< of the camera; empty: device_number selects it
  /// base_from_sensor: the sensor is the depth camera, x forward, y left, z up. [m] and, unlike elsewhere, [deg].
  double pose_x = 0, pose_y = 0, pose_z = 0, pose_yaw = 0, pose_pitch = 0, pose_roll = 0;
  bool grab_image = true, grab_imu = true;
  double imu_rate = 10;  ///< [1/s]
  Registration registration = Registration::ours;
  std::optional<double> tilt;  ///< [rad] of the optical axis above the horizon; empty: no motion
  Led led = Led::as_it_is;
  double max_range = 10;  ///< [m] farther pixels count as having no depth
  double pairing = 0.02;  ///< [s] largest time difference between a depth image and its picture
  double silence = 3;     ///< [s] without a depth image, after which the device counts as lost

  /// Whether the motor's device in the foot is needed, which is separate from the cameras on the USB bus.
  bool usesMotor() const { return tilt || led != Led::as_it_is || grab_imu; }
  mrpt::poses::CPose3D baseFromSensor() const;

  static const base::OptionTable<KinectOptions>& table();
  /// Reads a section of an INI that MRPT's drivers are given. If it has the focal lengths and the centre of a camera,
  /// that camera's lens has only the coefficients that the section has, so that no part of another device's calibration
  /// is mixed in. Throws Error unknown_key, wrong_type or out_of_range; the last also if only some of these four
  /// numbers of a camera are given.
  static KinectOptions read(const mrpt::config::CConfigFileBase& ini, const std::string& section);
};

}  // namespace omnimapper::drivers
