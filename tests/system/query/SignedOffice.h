#pragma once

#include <omnimapper/eval/TumFile.h>
#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/geometry/OpticalFrame.h>
#include <omnimapper/obs/CObservationDoorSigns.h>
#include <omnimapper/source/RawlogWriter.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "../Runs.h"

/// A simulated office with door signs, as a perfect reader of signs would observe them from a moving robot. No image is
/// rendered.
namespace runs {

using Eigen::Vector3d;
using nlohmann::json;
using omnimapper::geometry::Se3;

struct TrueSign {
  std::vector<std::string> lines;
  Vector3d position, normal;  // in the world; the normal points to where the sign can be read from

  bool has(const std::string& line) const { return std::find(lines.begin(), lines.end(), line) != lines.end(); }
};

inline std::vector<TrueSign> trueSigns(const std::string& folder) {
  std::vector<TrueSign> signs;
  const json truth = json::parse(readFile(folder + "/landmarks.json"));
  for (const auto& sign : truth["signs"]) {
    const auto& position = sign["pose"]["position"];
    const auto& q = sign["pose"]["quaternion_xyzw"];
    const Eigen::Quaterniond world_from_sign(q[3], q[0], q[1], q[2]);
    signs.push_back({sign["text"].get<std::vector<std::string>>(), Vector3d(position[0], position[1], position[2]),
                     world_from_sign * Vector3d::UnitZ()});
  }
  return signs;
}

/// The unit vector from a camera to a sign, both in the world. None if the sign is far or does not show its front.
inline std::optional<Vector3d> directionTo(const TrueSign& sign, const Vector3d& camera) {
  constexpr double kFar = 6, kAslant = 0.42;  // [m], cosine of 65 deg
  const Vector3d to_sign = sign.position - camera;
  const Vector3d direction = to_sign.normalized();
  if (to_sign.norm() > kFar || -direction.dot(sign.normal) < kAslant) return std::nullopt;
  return direction;
}

/// The observation of the signs by a camera at that pose of the base, with a random error of its pan of half a degree.
inline omnimapper::obs::CObservationDoorSigns::Ptr observedSigns(const std::vector<TrueSign>& signs,
                                                                 const omnimapper::eval::StampedPose& base,
                                                                 std::mt19937& random) {
  namespace geometry = omnimapper::geometry;
  std::normal_distribution<double> pan_off(0, 0.5 * geometry::kPi / 180);
  const Se3 base_from_camera{Eigen::Quaterniond::Identity(), Vector3d(0.1, 0, 1.45)};
  const Se3 world_from_camera = base.world_from_body * base_from_camera;
  const Eigen::AngleAxisd off(pan_off(random), Vector3d::UnitZ());
  auto observation = omnimapper::obs::CObservationDoorSigns::Create();
  observation->timestamp = base.stamp;
  observation->sensorLabel = "camera.signs";
  observation->source_label = "camera";
  observation->sensorPose = geometry::toMrpt(base_from_camera * geometry::sensorFromOptical());
  for (const auto& sign : signs) {
    const auto direction = directionTo(sign, world_from_camera.translation);
    if (!direction) continue;
    omnimapper::obs::ObservedDoorSign observed;
    observed.ray = geometry::inverse(world_from_camera * geometry::sensorFromOptical()).rotation * (off * *direction);
    // A sign looks narrower from the side and smaller from afar.
    const double range = (sign.position - world_from_camera.translation).norm();
    const auto height = static_cast<float>(200 / range),
               width = height * static_cast<float>(-direction->dot(sign.normal));
    observed.corners_px = {Eigen::Vector2f(0, 0), {width, 0}, {width, height}, {0, height}};
    for (const auto& line : sign.lines) observed.texts.push_back({line, 0.97});
    observation->signs.push_back(observed);
  }
  return observation;
}

/// Writes signs.rawlog beside a simulated log, with observations of its signs three times a second.
inline void writeObservedSigns(const std::string& folder) {
  constexpr std::size_t kEvery = 7;  // only every 7th pose is used; they are 50 ms apart
  const auto signs = trueSigns(folder);
  const auto truth = omnimapper::eval::readTum(folder + "/truth.tum");
  omnimapper::source::writeRawlog(folder + "/signs.rawlog", [&](omnimapper::source::RawlogWriter& writer) {
    std::mt19937 random(1);
    for (std::size_t i = 0; i < truth.size(); i += kEvery)
      if (const auto observed = observedSigns(signs, truth[i], random); !observed->signs.empty()) writer.add(*observed);
  });
}

/// The pose of the frame of a map in the world, computed from the first pose of the map's trajectory.
inline Se3 worldFromMap(const std::string& simulated, const std::string& map) {
  const auto estimate = omnimapper::eval::readTum(map + "/trajectory.tum");
  const auto truth = omnimapper::eval::readTum(simulated + "/truth.tum");
  const auto nearest = std::min_element(truth.begin(), truth.end(), [&](const auto& a, const auto& b) {
    const auto off = [&](const auto& pose) {
      return std::abs(omnimapper::base::secondsBetween(estimate.front().stamp, pose.stamp));
    };
    return off(a) < off(b);
  });
  return nearest->world_from_body * omnimapper::geometry::inverse(estimate.front().world_from_body);
}

}  // namespace runs
