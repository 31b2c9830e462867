// fakenect-session LOG FOLDER [PACE]: writes the data that a Kinect would have sent as a session that libfreenect's
// fakenect plays. LOG is a rawlog or a folder of depth and colour images. Its 640 x 480 depth images are written as raw
// values of 11 bits by the default calibration, with their pictures, and of its inertial observations the
// accelerations. PACE is a factor on the speed of the recording.
#include <libfreenect.h>
#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/obs/CObservationIMU.h>
#include <omnimapper/drivers/KinectCalibration.h>
#include <omnimapper/source/openLogs.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>

namespace {

using namespace omnimapper;
using mrpt::obs::CObservation3DRangeScan;

class Session {
 public:
  Session(const std::string& folder, double pace) : folder_(folder), pace_(pace) {
    std::filesystem::create_directories(folder);
    index_.open(folder + "/INDEX.txt");
  }

  void add(const CObservation3DRangeScan& scan) {
    using drivers::kKinectHeight, drivers::kKinectWidth;
    if (scan.rangeImage.rows() != kKinectHeight || scan.rangeImage.cols() != kKinectWidth || !scan.range_is_depth)
      throw std::runtime_error("the depth images of a Kinect are 640 x 480");
    const drivers::KinectCalibration calibration;
    std::string depths;
    for (const std::uint16_t units : std::vector(scan.rangeImage.begin(), scan.rangeImage.end())) {
      const int raw = calibration.rawOf(units * static_cast<double>(scan.rangeUnits));
      depths += static_cast<char>(raw & 0xff);  // in the host's byte order, as fakenect expects
      depths += static_cast<char>(raw >> 8);
    }
    write('d', ".pgm", scan.timestamp, "P5 640 480 65535\n" + depths);
    if (!scan.hasIntensityImage) return;
    const auto& image = scan.intensityImage;
    if (image.getWidth() != kKinectWidth || image.getHeight() != kKinectHeight || !image.isColor())
      throw std::runtime_error("the pictures of a Kinect are 640 x 480 and coloured");
    std::string picture;
    for (unsigned row = 0; row < kKinectHeight; ++row) {
      const auto* pixel = image.ptrLine<char>(row);
      for (int column = 0; column < kKinectWidth; ++column, pixel += 3)
        picture.append({pixel[2], pixel[1], pixel[0]});  // MRPT has blue first
    }
    write('r', ".ppm", scan.timestamp, "P6 640 480 255\n" + picture);
  }

  void add(const mrpt::obs::CObservationIMU& imu) {
    const auto counts = [&](mrpt::obs::TIMUDataIndex axis) {
      return static_cast<std::int16_t>(std::lround(imu.get(axis) / 9.80665 * FREENECT_COUNTS_PER_G));
    };
    freenect_raw_tilt_state state{};
    state.accelerometer_x = counts(mrpt::obs::IMU_Y_ACC);
    state.accelerometer_y = counts(mrpt::obs::IMU_Z_ACC);
    state.accelerometer_z = counts(mrpt::obs::IMU_X_ACC);
    write('a', ".dump", imu.timestamp, {reinterpret_cast<const char*>(&state), sizeof state});
  }

  bool finish() { return static_cast<bool>(index_.flush()); }

 private:
  void write(char kind, const char* extension, base::Stamp stamp, const std::string& bytes) {
    if (!begin_) begin_ = base::unixSeconds(stamp);
    const double seconds = *begin_ + (base::unixSeconds(stamp) - *begin_) / pace_;
    const double ticks = std::round(std::fmod(seconds, 4294967296 / 60e6) * 60e6);
    char name[80];
    std::snprintf(name, sizeof name, "%c-%.6f-%.0f%s", kind, seconds, ticks, extension);
    std::ofstream file(folder_ + "/" + name, std::ios::binary);
    if (!file.write(bytes.data(), static_cast<std::streamsize>(bytes.size())))
      throw std::runtime_error("cannot write " + folder_ + "/" + name);
    index_ << name << "\n";
  }

  std::string folder_;
  double pace_;
  std::optional<double> begin_;  // [s] since 1970
  std::ofstream index_;
};

}  // namespace

int main(int argc, char** argv) try {
  if (argc != 3 && argc != 4) return 2;
  const auto log = source::openLogs({argv[1]}, {});
  Session session(argv[2], argc == 4 ? std::stod(argv[3]) : 1);
  while (const auto observation = log->next()) {
    if (const auto scan = std::dynamic_pointer_cast<CObservation3DRangeScan>(observation)) {
      session.add(*scan);
    } else if (const auto imu = std::dynamic_pointer_cast<mrpt::obs::CObservationIMU>(observation)) {
      session.add(*imu);
    }
  }
  return session.finish() ? 0 : 1;
} catch (const std::exception& error) {
  std::cerr << error.what() << "\n";
  return 1;
}
