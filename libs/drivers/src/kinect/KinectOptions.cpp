#include <mrpt/core/bits_math.h>
#include <omnimapper/drivers/KinectOptions.h>

#include <algorithm>

#include "readDriverSection.h"

namespace omnimapper::drivers {

namespace {

using Numbers = std::vector<double KinectOptions::*>;

// Of one camera: whether the section tells its focal lengths and centre, all of them or none.
bool tellsCamera(const mrpt::config::CConfigFileBase& ini, const std::string& section, const std::string& camera) {
  const std::vector<std::string> keys{camera + "_fx_px", camera + "_fy_px", camera + "_cx_px", camera + "_cy_px"};
  const auto is_there = [&](const std::string& key) { return ini.keyExists(section, key); };
  const auto count = std::count_if(keys.begin(), keys.end(), is_there);
  if (count == 0) return false;
  const auto missing = std::find_if_not(keys.begin(), keys.end(), is_there);
  if (missing == keys.end()) return true;
  throw base::Error(base::ExitCode::out_of_range,
                    "[" + section + "] has no " + *missing + " beside what it has of the " + camera +
                        " camera; name all four of " + keys[0] + ", " + keys[1] + ", " + keys[2] + " and " + keys[3] +
                        ", or none of them for the defaults");
}

}  // namespace

KinectOptions KinectOptions::read(const mrpt::config::CConfigFileBase& ini, const std::string& section) {
  auto options = readDriverSection<KinectOptions>(ini, section);
  const auto forgetLens = [&](const std::string& camera, const Numbers& lens) {
    const std::vector<std::string> names{"_k1", "_k2", "_p1", "_p2", "_k3"};
    for (std::size_t i = 0; i < lens.size(); ++i) {
      if (!ini.keyExists(section, camera + names[i])) options.*lens[i] = 0;
    }
  };
  using Options = KinectOptions;
  if (tellsCamera(ini, section, "depth"))
    forgetLens("depth",
               {&Options::depth_k1, &Options::depth_k2, &Options::depth_p1, &Options::depth_p2, &Options::depth_k3});
  if (tellsCamera(ini, section, "picture"))
    forgetLens("picture", {&Options::picture_k1, &Options::picture_k2, &Options::picture_p1, &Options::picture_p2,
                           &Options::picture_k3});
  return options;
}

mrpt::poses::CPose3D KinectOptions::baseFromSensor() const {
  return {pose_x, pose_y, pose_z, mrpt::DEG2RAD(pose_yaw), mrpt::DEG2RAD(pose_pitch), mrpt::DEG2RAD(pose_roll)};
}

const base::OptionTable<KinectOptions>& KinectOptions::table() {
  using Options = KinectOptions;
  const base::Range focal{1, 1e5}, centre{-1e5, 1e5}, lens{-1000, 1000}, place{-10, 10};
  static const auto table =
      base::OptionTable<Options>()
          .integer("device_number", &Options::device_number, {0, 100},
                   "Which Kinect to open, counted from 0 in the order of the USB bus.")
          .text("serial", &Options::serial,
                "Serial number of the Kinect's camera; empty: device_number says which Kinect to open.")
          .number("pose_x", &Options::pose_x, {}, "Depth camera on the robot [m]: forward.")
          .number("pose_y", &Options::pose_y, {}, "Depth camera on the robot [m]: left.")
          .number("pose_z", &Options::pose_z, {}, "Depth camera on the robot [m]: up.")
          .number("pose_yaw", &Options::pose_yaw, {}, "Depth camera on the robot [deg]: turn about z.")
          .number("pose_pitch", &Options::pose_pitch, {}, "Depth camera on the robot [deg]: turn about y, down.")
          .number("pose_roll", &Options::pose_roll, {}, "Depth camera on the robot [deg]: turn about x.")
          .flag("grab_image", &Options::grab_image, "Take the colour picture along with the depths.")
          .flag("grab_IMU", &Options::grab_imu,
                "Read the accelerometer; false also leaves the motor's USB device alone.")
          .number("imu_rate_hz", &Options::imu_rate, {0.1, 100}, "How often the accelerometer is read.")
          .choice(
              "registration", &Options::registration,
              {{"none", Options::Registration::none},
               {"ours", Options::Registration::ours},
               {"device", Options::Registration::device}},
              "Camera frame of the depth image: none, the depth camera's (unregistered); ours, the colour camera's, "
              "registered with this section's calibration; device, registered by the device's own calibration (never "
              "tried on one).")
          .number("tilt_deg", &Options::tilt, {-30, 30},
                  "Angle above the horizon to which the motor turns the head at the start; empty: it stays as it is.")
          .choice("led", &Options::led,
                  {{"as_it_is", Options::Led::as_it_is},
                   {"off", Options::Led::off},
                   {"green", Options::Led::green},
                   {"red", Options::Led::red},
                   {"yellow", Options::Led::yellow},
                   {"blink_green", Options::Led::blink_green},
                   {"blink_red_yellow", Options::Led::blink_red_yellow}},
                  "Colour of the lamp while the sensor works.")
          .number("max_range_m", &Options::max_range, {0.1, 13}, "What is farther than this counts as no depth.")
          .number("pairing_s", &Options::pairing, {0, 1},
                  "Largest difference of time between a depth image and its picture; without one it has no picture.")
          .number("silence_s", &Options::silence, {0.2, 60},
                  "Time without a depth image after which the Kinect counts as lost.")
          .number("inverse_depth_at_zero_per_m", &Options::inverse_depth_at_zero, {},
                  "Inverse of the depth that the raw value 0 means.")
          .number("inverse_depth_step_per_m", &Options::inverse_depth_step, {-1, -1e-6},
                  "What one step of the raw value adds to the inverse of the depth.")
          .number("depth_fx_px", &Options::depth_fx, focal, "Focal length of the depth camera, along the columns.")
          .number("depth_fy_px", &Options::depth_fy, focal, "Focal length of the depth camera, along the rows.")
          .number("depth_cx_px", &Options::depth_cx, centre, "Column of the depth camera's optical axis.")
          .number("depth_cy_px", &Options::depth_cy, centre, "Row of the depth camera's optical axis.")
          .number("depth_k1", &Options::depth_k1, lens,
                  "Depth camera's lens, OpenCV's model: first radial coefficient.")
          .number("depth_k2", &Options::depth_k2, lens, "Depth camera's lens: second radial coefficient.")
          .number("depth_p1", &Options::depth_p1, lens, "Depth camera's lens: first tangential coefficient.")
          .number("depth_p2", &Options::depth_p2, lens, "Depth camera's lens: second tangential coefficient.")
          .number("depth_k3", &Options::depth_k3, lens, "Depth camera's lens: third radial coefficient.")
          .number("picture_fx_px", &Options::picture_fx, focal, "Focal length of the colour camera, along the columns.")
          .number("picture_fy_px", &Options::picture_fy, focal, "Focal length of the colour camera, along the rows.")
          .number("picture_cx_px", &Options::picture_cx, centre, "Column of the colour camera's optical axis.")
          .number("picture_cy_px", &Options::picture_cy, centre, "Row of the colour camera's optical axis.")
          .number("picture_k1", &Options::picture_k1, lens, "Colour camera's lens: first radial coefficient.")
          .number("picture_k2", &Options::picture_k2, lens, "Colour camera's lens: second radial coefficient.")
          .number("picture_p1", &Options::picture_p1, lens, "Colour camera's lens: first tangential coefficient.")
          .number("picture_p2", &Options::picture_p2, lens, "Colour camera's lens: second tangential coefficient.")
          .number("picture_k3", &Options::picture_k3, lens, "Colour camera's lens: third radial coefficient.")
          .number("picture_x_m", &Options::picture_x, place,
                  "Colour camera in the depth camera's frame (x forward, y left, z up): forward.")
          .number("picture_y_m", &Options::picture_y, place, "Colour camera in the depth camera's frame: left.")
          .number("picture_z_m", &Options::picture_z, place, "Colour camera in the depth camera's frame: up.")
          .number("picture_yaw_deg", &Options::picture_yaw, {},
                  "Colour camera's optical frame in the depth camera's frame: turn about z.")
          .number("picture_pitch_deg", &Options::picture_pitch, {}, "Colour camera's optical frame: turn about y.")
          .number("picture_roll_deg", &Options::picture_roll, {}, "Colour camera's optical frame: turn about x.");
  return table;
}

}  // namespace omnimapper::drivers
