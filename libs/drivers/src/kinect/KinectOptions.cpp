#include <mrpt/core/bits_math.h>
#include <omnimapper/camera/cameraOptions.h>
#include <omnimapper/drivers/KinectOptions.h>
#include <omnimapper/drivers/readDriverSection.h>

#include <algorithm>

namespace omnimapper::drivers {

namespace {

using Numbers = std::vector<double KinectOptions::*>;

// Whether the section has the focal lengths and the centre of a camera. Throws if it has only some of the four numbers.
bool hasCamera(const mrpt::config::CConfigFileBase& ini, const std::string& section, const std::string& camera) {
  const std::vector<std::string> keys{camera + "_fx_px", camera + "_fy_px", camera + "_cx_px", camera + "_cy_px"};
  const auto is_there = [&](const std::string& key) { return ini.keyExists(section, key); };
  const auto count = std::count_if(keys.begin(), keys.end(), is_there);
  if (count == 0) return false;
  const auto missing = std::find_if_not(keys.begin(), keys.end(), is_there);
  if (missing == keys.end()) return true;
  throw base::Error(base::ExitCode::out_of_range,
                    "[" + section + "] has no " + *missing + " beside the other numbers of the " + camera +
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
  if (hasCamera(ini, section, "depth"))
    forgetLens("depth",
               {&Options::depth_k1, &Options::depth_k2, &Options::depth_p1, &Options::depth_p2, &Options::depth_k3});
  if (hasCamera(ini, section, "picture"))
    forgetLens("picture", {&Options::picture_k1, &Options::picture_k2, &Options::picture_p1, &Options::picture_p2,
                           &Options::picture_k3});
  return options;
}

mrpt::poses::CPose3D KinectOptions::baseFromSensor() const {
  return {pose_x, pose_y, pose_z, mrpt::DEG2RAD(pose_yaw), mrpt::DEG2RAD(pose_pitch), mrpt::DEG2RAD(pose_roll)};
}

const base::OptionTable<KinectOptions>& KinectOptions::table() {
  using Options = KinectOptions;
  static const auto table = [] {
    base::OptionTable<Options> all;
    all.integer("device_number", &Options::device_number, {0, 100},
                "Number of the Kinect to open, counted from 0 in the order of the USB bus.")
        .text("serial", &Options::serial,
              "Serial number of the Kinect's camera; if empty, device_number selects the Kinect to open.")
        .number("pose_x", &Options::pose_x, {}, "Forward position of the depth camera on the robot [m].")
        .number("pose_y", &Options::pose_y, {}, "Leftward position of the depth camera on the robot [m].")
        .number("pose_z", &Options::pose_z, {}, "Upward position of the depth camera on the robot [m].")
        .number("pose_yaw", &Options::pose_yaw, {}, "Rotation of the depth camera on the robot about z [deg].")
        .number("pose_pitch", &Options::pose_pitch, {},
                "Rotation of the depth camera on the robot about y [deg], positive downwards.")
        .number("pose_roll", &Options::pose_roll, {}, "Rotation of the depth camera on the robot about x [deg].")
        .flag("grab_image", &Options::grab_image, "Takes the colour picture along with the depth image.")
        .flag("grab_IMU", &Options::grab_imu,
              "Reads the accelerometer; if false, the motor's USB device is not touched.")
        .number("imu_rate_hz", &Options::imu_rate, {0.1, 100}, "Rate at which the accelerometer is read.")
        .choice("registration", &Options::registration,
                {{"none", Options::Registration::none},
                 {"ours", Options::Registration::ours},
                 {"device", Options::Registration::device}},
                "Camera frame of the depth image: none, the depth camera's (unregistered); ours, the colour camera's, "
                "registered with this section's calibration; device, registered by the device's own calibration (never "
                "tried on one).")
        .number("tilt_deg", &Options::tilt, {-30, 30},
                "Angle above the horizon to which the motor turns the head at the start; empty leaves the head "
                "as it is.")
        .choice("led", &Options::led,
                {{"as_it_is", Options::Led::as_it_is},
                 {"off", Options::Led::off},
                 {"green", Options::Led::green},
                 {"red", Options::Led::red},
                 {"yellow", Options::Led::yellow},
                 {"blink_green", Options::Led::blink_green},
                 {"blink_red_yellow", Options::Led::blink_red_yellow}},
                "Colour of the Kinect's lamp while the sensor works.")
        .number("max_range_m", &Options::max_range, {0.1, 13}, "Pixels farther than this count as having no depth.")
        .number("pairing_s", &Options::pairing, {0, 1},
                "Largest time difference between a depth image and its picture; a depth image without such a "
                "picture has none.")
        .number("silence_s", &Options::silence, {0.2, 60},
                "Time without a depth image after which the Kinect counts as lost.")
        .number("inverse_depth_at_zero_per_m", &Options::inverse_depth_at_zero, {},
                "Inverse depth that corresponds to the raw value 0.")
        .number("inverse_depth_step_per_m", &Options::inverse_depth_step, {-1, -1e-6},
                "Change of the inverse depth for one step of the raw value.");
    camera::addIntrinsics(all);
    camera::addPicturePose(all);
    return all;
  }();
  return table;
}

}  // namespace omnimapper::drivers
