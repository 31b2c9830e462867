#include <mrpt/obs/CObservation2DRangeScan.h>
#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/sim/Laser2d.h>

#include <algorithm>
#include <cmath>

#include "OptionChecks.h"
#include "PersonBeams.h"
#include "TruthText.h"
#include "opticsTable.h"

namespace omnimapper::sim {

namespace {

constexpr double kDegree = base::option_text::kRadiansPerDegree;
constexpr std::uint64_t kBeamStreams2d = 0x100;  // of the first beam; the others have the numbers after it
constexpr double kSweepAge = 0.005;              // [s] part of a sweep during which people count as standing still

bool somethingMoves(const World& world) {
  return std::any_of(world.bodies.begin(), world.bodies.end(),
                     [](const Body& body) { return body.track.kind() == Track::Kind::motion; });
}

}  // namespace

Laser2dOptions::Laser2dOptions() {
  *this = ofModel(Laser2dModel::sick_lms291);
}

// Apertures, times and ranges are those of the makers' data sheets; noise, mixing and losses of the SICK are tuned to
// recordings (doc/results/simulator.md), those of the Hokuyos are from their data sheets and Kneip et al.,
// "Characterization of the compact Hokuyo URG-04LX 2D laser range scanner", ICRA 2009.
Laser2dOptions Laser2dOptions::ofModel(Laser2dModel model) {
  Laser2dOptions o{std::in_place};
  o.model = model;
  switch (model) {
    case Laser2dModel::sick_lms291:
      // 75 turns in a second, half a turn for the scan.
      o.beams = 181, o.aperture = 180 * kDegree, o.sweep = 0.5 / 75;
      o.min_range = 0.05, o.max_range = 81.83, o.white_range = 85, o.divergence = 0.6 * kDegree;
      o.noise = 0.007, o.noise_per_metre = 0.0007, o.step = 0.01;
      o.mixing_gap = 4, o.mixing = 0.5, o.lost = 0.0005, o.glass_angle = 6 * kDegree;
      break;
    case Laser2dModel::sick_pls:
      // The older model, with ranges of up to 50 m in steps of 5 cm, as in the log ACES. 25 turns in a second.
      o.beams = 180, o.aperture = 179 * kDegree, o.sweep = 0.5 / 25;
      o.min_range = 0.05, o.max_range = 50, o.white_range = 55, o.divergence = 0.7 * kDegree;
      o.noise = 0.016, o.noise_per_metre = 0.0003, o.step = 0.05;
      o.mixing_gap = 5, o.mixing = 0.65, o.lost = 0.0005, o.glass_angle = 6 * kDegree;
      break;
    case Laser2dModel::hokuyo_utm30:
      o.beams = 1081, o.aperture = 270 * kDegree, o.sweep = 0.75 / 40;
      o.min_range = 0.1, o.max_range = 30, o.white_range = 35, o.divergence = 0.25 * kDegree;
      o.noise = 0.009, o.noise_per_metre = 0.0002, o.step = 0.001;
      o.mixing_gap = 5, o.mixing = 0.4, o.lost = 0.001, o.glass_angle = 8 * kDegree;
      break;
    case Laser2dModel::hokuyo_urg04:
      o.beams = 682, o.aperture = 681 * 360.0 / 1024 * kDegree, o.sweep = 681.0 / 1024 / 10;
      o.min_range = 0.02, o.max_range = 4.095, o.white_range = 5.6, o.divergence = 0.5 * kDegree;
      o.noise = 0.003, o.noise_per_metre = 0.004, o.step = 0.001;
      o.mixing_gap = 1.0, o.mixing = 0.8, o.lost = 0.003, o.glass_angle = 10 * kDegree;
      break;
    case Laser2dModel::ideal:
      o.beams = 361, o.aperture = 180 * kDegree;
      break;
  }
  return o;
}

const base::OptionTable<Laser2dOptions>& Laser2dOptions::table() {
  using base::Range;
  using Options = Laser2dOptions;
  const Range zero_or_more = Range::notNegative();
  static const auto table =
      withOptics(
          base::OptionTable<Options>()
              .choice("model", &Options::model,
                      {{"sick_lms291", Laser2dModel::sick_lms291},
                       {"sick_pls", Laser2dModel::sick_pls},
                       {"hokuyo_utm30", Laser2dModel::hokuyo_utm30},
                       {"hokuyo_urg04", Laser2dModel::hokuyo_urg04},
                       {"ideal", Laser2dModel::ideal}},
                      "Laser model that gives the values of keys that are not given. The listed defaults are those of "
                      "the first model.")
              .integer("beams", &Options::beams, {2, 100000}, "Number of beams in a scan.")
              .number("aperture_deg", &Options::aperture, {1, 360}, "Angle from the first beam of a scan to the last.")
              .flag("counter_clockwise", &Options::counter_clockwise, "The laser scans from right to left.")
              .number("sweep_s", &Options::sweep, zero_or_more,
                      "Time from the first beam of a scan, which is measured at the stamp, to the last."))
          .flag("no_echo_is_max", &Options::no_echo_is_max,
                "A beam without an echo reports max_range_m as its range instead of 0.")
          .flag("intensity", &Options::intensity, "Scans contain the intensities of the echoes, from 0 to 255.")
          .flag("truth_ranges", &Options::truth_ranges, "The ground truth contains the true range of each beam.");
  return table;
}

Laser2d::Laser2d(const Laser2dOptions& options, const SensorOptions& mount, const SensorContext& context)
    : Sensor(mount, context),
      options_(options),
      optics_(options, *context.scenes, 3),
      person_beams_(std::make_shared<PersonBeams>(*context.world)) {
  requireBelow(context.place(), "min_range_m", options.min_range, "max_range_m", options.max_range);
}

std::vector<Echo> Laser2d::echoes(int k) const {
  // MRPT keeps the aperture in single precision; beams are cast at the angles that a reader of the log will assume.
  const double aperture = static_cast<double>(static_cast<float>(options_.aperture));
  const double sign = options_.counter_clockwise ? 1 : -1;
  const int slices = options_.sweep > kSweepAge && somethingMoves(*context().world)
                         ? static_cast<int>(std::ceil(options_.sweep / kSweepAge))
                         : 1;
  std::vector<Echo> all;
  for (int slice = 0; slice < slices; ++slice) {
    const int first = options_.beams * slice / slices, end = options_.beams * (slice + 1) / slices;
    std::vector<Beam> beams;
    std::vector<Random> randoms;
    double middle = 0;
    for (int i = first; i < end; ++i) {
      const double part = static_cast<double>(i) / (options_.beams - 1), time = timeOf(k) + options_.sweep * part;
      const double angle = sign * aperture * (part - 0.5);
      const geometry::Se3 map_from_sensor = mapFromSensor(time);
      beams.push_back({map_from_sensor.translation,
                       (map_from_sensor.rotation * Eigen::Vector3d(std::cos(angle), std::sin(angle), 0)).normalized()});
      randoms.push_back(randomOf(k, kBeamStreams2d + static_cast<std::uint64_t>(i)));
      middle += time / (end - first);
    }
    const auto echoes = optics_.measure(context().scenes->at(middle), beams, std::move(randoms));
    all.insert(all.end(), echoes.begin(), echoes.end());
  }
  return all;
}

Measurement Laser2d::measure(int k) const {
  const std::vector<Echo> all = echoes(k);
  auto scan = mrpt::obs::CObservation2DRangeScan::Create();
  stamp(*scan, k);
  scan->sensorPose = geometry::toMrpt(baseFromSensor());
  scan->aperture = static_cast<float>(options_.aperture);
  scan->rightToLeft = options_.counter_clockwise;
  scan->maxRange = static_cast<float>(options_.max_range);
  scan->stdError = static_cast<float>(std::max(options_.noise, 1e-3));
  scan->beamAperture = static_cast<float>(options_.divergence);
  scan->resizeScan(all.size());
  scan->setScanHasIntensity(options_.intensity);
  const auto none = static_cast<float>(options_.no_echo_is_max ? options_.max_range : 0);
  auto truth_ranges = nlohmann::ordered_json::array();
  for (std::size_t i = 0; i < all.size(); ++i) {
    scan->setScanRange(i, all[i].is_valid ? static_cast<float>(all[i].range) : none);
    scan->setScanRangeValidity(i, all[i].is_valid);
    if (options_.intensity)
      scan->setScanIntensity(i, all[i].is_valid ? static_cast<int>(255 * std::min(1.0, all[i].reflected)) : 0);
    if (options_.truth_ranges) truth_ranges.push_back(rounded(all[i].true_range));
  }
  nlohmann::ordered_json truth = truthOf(all);
  if (options_.truth_ranges) truth["ranges"] = truth_ranges;
  Measurement measurement{scan, truth.dump(), {}, seenPoints(all)};
  if (person_beams_->hasPeople())
    measurement.body_rows = person_beams_->rows(all, k, base::formatUnix(stampOf(k)), timeOf(k));
  return measurement;
}

SensorClass laser2dClass() {
  const auto make = [](const base::ConfigSection& section, const SensorOptions& mount,
                       const SensorContext& context) -> std::unique_ptr<Sensor> {
    std::vector<std::string> others{"class"};
    for (const auto& spec : SensorOptions::table().specs()) others.push_back(spec.key);
    const auto& specs = Laser2dOptions::table().specs();
    // read() checks all keys; those that are given then replace the values of the model.
    Laser2dOptions options = Laser2dOptions::ofModel(section.read<Laser2dOptions>(others).model);
    for (std::size_t i = 0; i < specs.size(); ++i) {
      std::string text;
      if (section.find(specs[i].key, text)) Laser2dOptions::table().set(options, i, text);
    }
    return std::make_unique<Laser2d>(options, mount, context);
  };
  SensorClass laser{"Laser2d", "A 2D laser with the noise, mixed pixels, glass and dark surfaces of a real one.",
                    Laser2dOptions::table().specs(), make};
  const std::set<std::string> free_of_model{"model", "counter_clockwise", "no_echo_is_max", "intensity",
                                            "truth_ranges"};
  for (const auto& spec : laser.options) {
    if (free_of_model.count(spec.key) == 0) laser.of_model.insert(spec.key);
  }
  return laser;
}

}  // namespace omnimapper::sim
