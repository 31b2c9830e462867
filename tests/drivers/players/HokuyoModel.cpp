#include "HokuyoModel.h"

#include <omnimapper/base/Error.h>
#include <omnimapper/base/Numbers.h>

#include <algorithm>
#include <cmath>

namespace omnimapper::players {

namespace {

[[noreturn]] void refuse(const mrpt::obs::CObservation2DRangeScan& scan, const std::string& why) {
  throw base::Error(base::ExitCode::unreadable_input,
                    "The scans of \"" + scan.sensorLabel + "\" cannot be those of a Hokuyo: " + why);
}

}  // namespace

HokuyoModel HokuyoModel::fitting(const mrpt::obs::CObservation2DRangeScan& scan, double rate) {
  const int beams = static_cast<int>(scan.getScanSize());
  if (beams < 2 || !(scan.aperture > 0)) refuse(scan, "they have fewer than two beams.");
  HokuyoModel model;
  const double spacing = scan.aperture / (beams - 1);
  model.steps_per_turn = static_cast<int>(std::lround(2 * M_PI / spacing));
  const double outermost_error = std::abs(2 * M_PI / model.steps_per_turn - spacing) * (beams - 1) / 2;
  if (outermost_error > spacing / 10)
    refuse(scan, "the outermost of its " + std::to_string(beams) + " beams would be off by " +
                     base::brief(outermost_error * 180 / M_PI, 2) + " degrees, for a full turn is no multiple of " +
                     base::brief(spacing * 180 / M_PI, 4) + " degrees.");
  model.first = 0;
  model.last = beams - 1;
  model.front = model.last / 2;
  if (model.last > 9999) refuse(scan, "more than 10,000 beams.");
  model.max_mm = static_cast<int>(std::lround(std::min(scan.maxRange, 1e6f) * 1000));
  if (model.max_mm >= 1 << 18) refuse(scan, "their largest range is more than 262 m.");
  model.rpm = static_cast<int>(std::lround(60 * rate));
  model.name = "OMNIPLAY";
  return model;
}

HokuyoScan hokuyoScan(const mrpt::obs::CObservation2DRangeScan& scan, const HokuyoModel& model) {
  const auto beams = scan.getScanSize();
  HokuyoScan played;
  played.ranges_mm.resize(beams);
  if (scan.hasIntensity()) played.intensities.resize(beams);
  for (std::size_t beam = 0; beam < beams; ++beam) {
    const std::size_t step = scan.rightToLeft ? beam : beams - 1 - beam;
    const double mm = std::round(scan.getScanRange(beam) * 1000.0);
    const bool is_measured = scan.getScanRangeValidity(beam) && mm >= model.min_mm && mm <= model.max_mm;
    played.ranges_mm[step] = is_measured ? static_cast<std::uint32_t>(mm) : 0;
    if (scan.hasIntensity())
      played.intensities[step] = static_cast<std::uint32_t>(std::clamp(scan.getScanIntensity(beam), 0, (1 << 18) - 1));
  }
  return played;
}

}  // namespace omnimapper::players
