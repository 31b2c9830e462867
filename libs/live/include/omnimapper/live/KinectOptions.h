#pragma once

#include <omnimapper/base/OptionTable.h>
#include <omnimapper/live/KinectCalibration.h>

#include <optional>
#include <string>

namespace omnimapper::live {

/// Section of a KinectSensor in an INI file. Keys that MRPT's drivers have in common keep MRPT's names: pose_x to pose_z
/// [m], pose_yaw to pose_roll [deg], grab_image, grab_IMU, device_number.
struct KinectOptions : KinectCalibration {
  enum class Registration { ours, device };
  enum class Led { as_it_is, off, green, red, yellow, blink_green, blink_red_yellow };

  int device_number = 0;  ///< counted from 0 in the order of the USB bus
  std::string serial;     ///< of the camera; empty: device_number says which
  /// base_from_sensor: the sensor is the depth camera, x forward, y left, z up. [m] and, unlike elsewhere, [deg].
  double pose_x = 0, pose_y = 0, pose_z = 0, pose_yaw = 0, pose_pitch = 0, pose_roll = 0;
  bool grab_image = true, grab_imu = true;
  double imu_rate = 10;                            ///< [1/s]
  Registration registration = Registration::ours;  ///< who relates the picture to the depths
  std::optional<double> tilt;                      ///< [rad] of the optical axis above the horizon; empty: no motion
  Led led = Led::as_it_is;
  double max_range = 10;             ///< [m] what is farther counts as no depth
  double pairing = 0.02;             ///< [s] largest difference of time between a depth image and its picture
  double silence = 3;                ///< [s] without a depth image, after which the device counts as lost
  bool usesMotor() const { return tilt || led != Led::as_it_is || grab_imu; }
  mrpt::poses::CPose3D baseFromSensor() const;

  static const base::OptionTable<KinectOptions>& table();
};

}  // namespace omnimapper::live
