// box-log OUT.rawlog TRUTH.txt SEED: writes the log of a simulated robot that drives two rounds past twelve objects,
// with its odometry and the boxes that a detector finds, and a file with the class and the true middle of each object:
// "x y z class" per line [m]. The detector misses some objects, and is not sure of the class of others.
#include <mrpt/obs/CObservationOdometry.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/base/Stamp.h>
#include <omnimapper/obs/CObservationObjects.h>
#include <omnimapper/source/RawlogWriter.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iostream>
#include <random>
#include <string>
#include <vector>

namespace {

using mrpt::poses::CPose2D;
using mrpt::poses::CPose3D;

struct TrueObject {
  std::string class_label;
  double x, y, yaw;
  Eigen::Vector3d size;  // [m] it stands on the floor
};

const Eigen::Vector3d kChair(0.5, 0.5, 0.9), kTable(1.4, 0.8, 0.75), kPlant(0.4, 0.4, 1.1), kShelf(1.0, 0.4, 1.8);
const std::vector<TrueObject> kObjects = {
    {"table", 2, -2, 0.2, kTable},  {"chair", 1, -2, 0.3, kChair},    {"chair", 3.1, -2, 2.9, kChair},
    {"plant", 4.5, 1, 0, kPlant},   {"shelf", 5.5, 3.5, 1.6, kShelf}, {"plant", 4.5, 6.5, 0, kPlant},
    {"table", 2.8, 8, 0.1, kTable}, {"chair", 1.5, 8, 1, kChair},     {"shelf", -1, 8.2, 0, kShelf},
    {"chair", -4.5, 6, 2, kChair},  {"plant", -5.2, 2.5, 0, kPlant},  {"shelf", -3, -1, 0.7, kShelf},
};

// The base stands at the origin for a second, where the map begins, and drives a circle with a radius of 3 m to the
// left.
constexpr double kRadius = 3, kSpeed = 0.5, kStep = 0.05, kSeconds = 80;  // [m] [m/s] [s] [s]: two rounds

CPose2D poseAt(double seconds) {
  const double angle = kSpeed * std::max(0.0, seconds - 1) / kRadius;
  return {kRadius * std::sin(angle), kRadius - kRadius * std::cos(angle), angle};
}

// Normally distributed; the standard library's own distribution differs between libraries.
double normal(std::mt19937_64& engine, double sigma) {
  double sum = -6;
  for (int i = 0; i < 12; ++i) sum += static_cast<double>(engine() >> 11) / 9007199254740992.0;
  return sigma * sum;
}

omnimapper::obs::CObservationObjects detected(const CPose2D& map_from_base, std::mt19937_64& noise) {
  constexpr double kSigma = 0.03, kReach = 5, kHalfView = 0.9;  // [m] [m] [rad]
  omnimapper::obs::CObservationObjects observation;
  observation.sensorLabel = "camera.objects";
  observation.source_label = "camera";
  observation.sensorPose = CPose3D(0.1, 0, 1, 0, 0, 0);
  const CPose3D sensor_from_map = CPose3D() - (CPose3D(map_from_base) + observation.sensorPose);
  for (const auto& object : kObjects) {
    const CPose3D there = sensor_from_map + CPose3D(object.x, object.y, object.size.z() / 2, object.yaw, 0, 0);
    const double draw = normal(noise, 1);
    if (there.x() < 0.3 || there.norm() > kReach || std::abs(std::atan2(there.y(), there.x())) > kHalfView) continue;
    if (draw > 1.5) continue;  // missed
    omnimapper::obs::ObservedObject found;
    const Eigen::Quaterniond axes(Eigen::AngleAxisd(there.yaw(), Eigen::Vector3d::UnitZ()));
    found.sensor_from_box = {
        axes,
        {there.x() + normal(noise, kSigma), there.y() + normal(noise, kSigma), there.z() + normal(noise, kSigma)}};
    found.centroid = found.sensor_from_box.translation;
    found.covariance = kSigma * kSigma * Eigen::Matrix3d::Identity();
    found.box_size = object.size;
    found.class_label = draw < -1.5 ? "thing" : object.class_label;
    found.score = draw < -1.5 ? 0.2 : 0.9;
    observation.objects.push_back(found);
  }
  return observation;
}

void writeDrive(const std::string& path, std::uint64_t seed) {
  std::mt19937_64 noise(seed);
  omnimapper::source::writeRawlog(path, [&](omnimapper::source::RawlogWriter& log) {
    CPose2D odometry;
    for (int step = 0; step * kStep < kSeconds; ++step) {
      const double seconds = step * kStep;
      if (step > 0) {
        const CPose2D motion = poseAt(seconds) - poseAt(seconds - kStep);
        odometry = odometry +
                   CPose2D(1.005 * motion.x() + normal(noise, 1e-3), motion.y(), motion.phi() + normal(noise, 3e-4));
      }
      mrpt::obs::CObservationOdometry wheels;
      wheels.sensorLabel = "odometry";
      wheels.timestamp = omnimapper::base::stampFromUnix(1.7e9 + seconds);
      wheels.odometry = odometry;
      log.add(wheels);
      if (step % 10 != 5) continue;
      auto objects = detected(poseAt(seconds), noise);
      objects.timestamp = wheels.timestamp;
      log.add(objects);
    }
  });
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) {
    std::cerr << "usage: box-log OUT.rawlog TRUTH.txt SEED\n";
    return 2;
  }
  try {
    writeDrive(argv[1], std::stoull(argv[3]));
    std::ofstream truth(argv[2]);
    for (const auto& object : kObjects)
      truth << object.x << " " << object.y << " " << object.size.z() / 2 << " " << object.class_label << "\n";
  } catch (const omnimapper::base::Error& error) {
    std::cerr << "box-log: " << error.what() << "\n";
    return static_cast<int>(error.code());
  }
}
