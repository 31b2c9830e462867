#include <mrpt/maps/CPointsMapXYZI.h>
#include <mrpt/obs/CObservationPointCloud.h>
#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/sim/Laser3d.h>

#include <algorithm>
#include <cmath>

#include "OptionChecks.h"
#include "TruthText.h"
#include "opticsTable.h"

namespace omnimapper::sim {

namespace {
constexpr std::uint64_t kBeamStreams3d = 0x100;
constexpr double kSliceAge = 0.01;  // [s] during which people count as standing still
}  // namespace

// Values from the data sheet of the Velodyne VLP-16 (range 100 m, 3 cm typical accuracy, 2 mm steps, beam of 3 mrad).
Laser3dOptions::Laser3dOptions() {
  min_range = 0.4, max_range = 100, white_range = 110, divergence = 0.003;
  noise = 0.012, noise_per_metre = 0.0003, step = 0.002;
  mixing_gap = 0.5, mixing = 0.3, lost = 0.002, glass_angle = 0.1;
}

const base::OptionTable<Laser3dOptions>& Laser3dOptions::table() {
  using Options = Laser3dOptions;
  static const auto table = withOptics(
      base::OptionTable<Options>()
          .integer("rings", &Options::rings, {1, 256}, "Number of rings, which is the number of beams in each column.")
          .number("lowest_deg", &Options::lowest, {-89, 89}, "Elevation of the lowest ring, positive upwards.")
          .number("highest_deg", &Options::highest, {-89, 89}, "Elevation of the highest ring, positive upwards.")
          .integer("columns", &Options::columns, {4, 10000}, "Number of columns in a turn.")
          .flag("takes_time", &Options::takes_time,
                "A turn takes 1 / rate_hz. Otherwise the whole turn is measured at one time."));
  return table;
}

Laser3d::Laser3d(const Laser3dOptions& options, const SensorOptions& mount, const SensorContext& context)
    : Sensor(mount, context), options_(options), optics_(options, *context.scenes, 1) {
  requireBelow(context.place(), "min_range_m", options.min_range, "max_range_m", options.max_range);
}

Measurement Laser3d::measure(int k) const {
  const double turn_time = options_.takes_time ? 1 / options().rate : 0;
  const int slices = std::clamp(static_cast<int>(std::ceil(turn_time / kSliceAge)), 1, options_.columns);
  auto points = mrpt::maps::CPointsMapXYZI::Create();
  std::vector<Echo> kept;
  for (int slice = 0; slice < slices; ++slice) {
    const int first = options_.columns * slice / slices, end = options_.columns * (slice + 1) / slices;
    std::vector<Beam> beams;
    std::vector<Random> randoms;
    std::vector<Eigen::Vector3d> directions_in_sensor;
    for (int column = first; column < end; ++column) {
      const double part = static_cast<double>(column) / options_.columns, azimuth = -2 * M_PI * part;
      const geometry::Se3 map_from_sensor = mapFromSensor(timeOf(k) + turn_time * part);
      for (int ring = 0; ring < options_.rings; ++ring) {
        const double share = options_.rings > 1 ? static_cast<double>(ring) / (options_.rings - 1) : 0;
        const double elevation = options_.lowest + share * (options_.highest - options_.lowest);
        directions_in_sensor.emplace_back(std::cos(elevation) * std::cos(azimuth),
                                          std::cos(elevation) * std::sin(azimuth), std::sin(elevation));
        beams.push_back({map_from_sensor.translation, map_from_sensor.rotation * directions_in_sensor.back()});
        randoms.push_back(randomOf(k, kBeamStreams3d + static_cast<std::uint64_t>(column * options_.rings + ring)));
      }
    }
    const double middle = timeOf(k) + turn_time * 0.5 * (first + end) / options_.columns;
    const auto echoes = optics_.measure(context().scenes->at(middle), beams, std::move(randoms));
    for (std::size_t i = 0; i < echoes.size(); ++i) {
      if (!echoes[i].is_valid) continue;
      const Eigen::Vector3f point = (echoes[i].range * directions_in_sensor[i]).cast<float>();
      points->insertPointFast(point.x(), point.y(), point.z());
      points->setPointIntensity(kept.size(), static_cast<float>(std::min(1.0, echoes[i].reflected)));
      kept.push_back(echoes[i]);
    }
  }
  auto cloud = mrpt::obs::CObservationPointCloud::Create();
  stamp(*cloud, k);
  cloud->sensorPose = geometry::toMrpt(baseFromSensor());
  cloud->pointcloud = points;
  nlohmann::ordered_json truth = truthOf(kept);
  return {cloud, truth.dump(), {}, seenPoints(kept)};
}

}  // namespace omnimapper::sim
