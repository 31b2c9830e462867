#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/obs/CObservationIMU.h>
#include <omnimapper/check/gatherFacts.h>
#include <omnimapper/check/judge.h>
#include <omnimapper/geometry/Rotation3.h>
#include <omnimapper/mapper/EngineOptions.h>
#include <omnimapper/motion/Gyroscope.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "BeamsAhead.h"
#include "CameraFit.h"
#include "Conclusions.h"
#include "ImageSizes.h"
#include "LevelStatistics.h"
#include "OdometryStatistics.h"
#include "PoseStatistics.h"
#include "ScanPairs.h"
#include "ScanStatistics.h"
#include "StampStatistics.h"
#include "SweepFit.h"
#include "compareMotions.h"

namespace omnimapper::check {

namespace {

using mrpt::obs::CObservation2DRangeScan;

// Iterator behind the first `count` elements.
template <class Map>
typename Map::const_iterator beginningOf(const Map& map, std::size_t count) {
  return std::next(map.begin(), static_cast<std::ptrdiff_t>(std::min(count, map.size())));
}

}  // namespace

// Collects all statistics while the log is read.
class FactGatherer::Statistics {
 public:
  explicit Statistics(IniFacts ini) : ini_(std::move(ini)) {}

  void add(const mrpt::obs::CObservation::Ptr& observation) {
    const auto stamp = observation->timestamp;
    const std::string& label = observation->sensorLabel;
    clock_.add(stamp);
    stamps_[{label, observation->GetRuntimeClass()->className}].add(stamp, clock_);
    if (OdometryStatistics::isOdometry(*observation)) odometry_[label].add(*observation);
    if (dynamic_cast<const mrpt::obs::CObservationIMU*>(observation.get())) {
      const bool is_known = gyroscopes_.size() < kMostLabels || gyroscopes_.count(label) > 0;
      if (is_known && gyroscopes_[label].sensor.add(*observation)) gyroscopes_[label].stamps.push_back(stamp);
    }
    level_.add(*observation);
    sizes_.add(*observation);
    if (const auto pose = std::dynamic_pointer_cast<const mrpt::obs::CObservationRobotPose>(observation)) {
      poses_[label].add(*pose);
    }
    if (const auto image = std::dynamic_pointer_cast<const mrpt::obs::CObservation3DRangeScan>(observation)) {
      if (images_.size() < kMostLabels || images_.count(label) > 0) images_[label].add(image);
      const bool is_calibrated = image->cameraParams.fx() > 0 && image->cameraParams.fy() > 0;
      if (image->hasRangeImage && !is_calibrated) {
        auto& left_out = uncalibrated_[{label,
                                        "the camera is not calibrated: its focal length is not positive; set "
                                        "depth_fx_px and depth_fy_px in [calibration]"}];
        if (left_out.observations++ == 0) left_out.first_stamp = stamp;
      }
    }
    if (const auto scan = std::dynamic_pointer_cast<const CObservation2DRangeScan>(observation)) {
      auto& laser = lasers_.try_emplace(label, Laser{ScanStatistics(ini_.max_range), {}, {}, {}}).first->second;
      laser.statistics.add(*scan);
      laser.pairs.add(scan);
      if (lasers_.size() <= kMostLabels) laser.walls.add(scan);
      if (base::isValid(stamp)) laser.stamps.push_back(stamp);
    }
  }

  LogFacts facts() const {
    LogFacts facts;
    facts.ini = ini_;
    facts.unusable = uncalibrated_;
    for (const auto& [sensor, statistics] : stamps_) facts.sensors[sensor] = stampFacts(statistics);
    for (const auto& [label, statistics] : odometry_) facts.odometry[label] = statistics.facts();
    for (const auto& [label, statistics] : poses_) facts.poses[label] = statistics.facts();
    facts.other_sizes = sizes_.facts();
    std::vector<SampledImage> images;
    std::map<std::string, std::vector<SampledImage>> by_label;
    for (const auto& [label, sampled] : images_) {
      by_label[label] = sampled.all();
      images.insert(images.end(), by_label[label].begin(), by_label[label].end());
    }
    facts.levels = level_.facts(!odometry_.empty(), images);
    const auto compared = beginningOf(odometry_, kMostLabels);
    for (auto a = odometry_.begin(); a != compared; ++a) {
      for (auto b = std::next(a); b != compared; ++b) {
        facts.odometry_pairs.push_back(compareOdometries(a->first, a->second, b->first, b->second));
      }
    }
    for (const auto& [label, laser] : lasers_) {
      facts.scans[label] = laser.statistics.facts();
      if (facts.scans.size() > kMostLabels) continue;
      for (auto odometry = odometry_.begin(); odometry != compared; ++odometry) {
        compare(label, laser, odometry->first, &odometry->second, facts);
        facts.covered[{label, odometry->first}] = coveredShare(laser, odometry->second);
      }
      if (odometry_.empty()) compare(label, laser, "", nullptr, facts);
    }
    addCameras(by_label, facts);
    return facts;
  }

 private:
  // No robot has more lasers, odometries, gyroscopes or cameras; comparing a log with more labels would take minutes.
  static constexpr std::size_t kMostLabels = 10;

  struct Laser {
    ScanStatistics statistics;
    ScanPairs pairs;
    WallTrack walls;
    std::vector<base::Stamp> stamps;
  };

  // Compares the depth cameras with the best laser, and the best odometry at the moments of that laser.
  void addCameras(const std::map<std::string, std::vector<SampledImage>>& by_label, LogFacts& facts) const {
    const auto lasers = usableLasers(facts);
    const auto odometry = usableOdometry(facts);
    if (!odometry) return;
    double late = 0;  // stamps of the odometry against those of the laser [s]
    for (const auto& motion : facts.motions) {
      const bool is_wanted = !lasers.empty() && motion.laser == lasers.front() && motion.odometry == *odometry;
      if (is_wanted && motion.clock && motion.clock->isWrong()) late = motion.clock->offset;
    }
    const auto& wheels = odometry_.at(*odometry);
    const auto between = [&](base::Stamp begin, base::Stamp end) {
      const auto shift = base::durationFromSeconds(late);
      return wheels.between(begin + shift, end + shift);
    };
    CameraWitness witness;
    witness.sees_walls = !lasers.empty();
    witness.walls = [&](base::Stamp stamp) {
      return lasers.empty() ? std::vector<BaseWall>() : lasers_.at(lasers.front()).walls.wallsAt(stamp, between);
    };
    witness.turning = [&](base::Stamp stamp) -> std::optional<double> {
      const auto half = base::durationFromSeconds(0.15);
      const auto motion = between(stamp - half, stamp + half);
      return motion ? std::optional(motion->phi() / 0.3) : std::nullopt;
    };
    for (const auto& [label, images] : by_label) {
      if (images.empty()) continue;
      facts.cameras.push_back(fitCamera(images, witness));
      auto& clock = facts.cameras.back().clock;
      if (clock && !lasers.empty()) clock->value -= 0.5 * sweepOf(facts.scans.at(lasers.front()));
      facts.cameras.back().has_negative_focal = images_.at(label).haveNegativeFocal();
      if (!lasers.empty()) facts.cameras.back().laser = lasers.front();
    }
  }

  struct Gyroscope {
    motion::Gyroscope sensor{{}};
    std::vector<base::Stamp> stamps;

    Headings headings() const {
      return headingsOf(stamps, [this](base::Stamp begin, base::Stamp end) {
        const auto turn = sensor.between(begin, end);
        return turn ? geometry::logSo3(turn->begin_from_end).z() : std::nan("");
      });
    }
  };

  StampFacts stampFacts(const StampStatistics& statistics) const {
    StampFacts facts = statistics.facts();
    for (const auto& [begin, end] : statistics.gaps()) {
      if (isRest(begin, end)) {
        ++facts.rests;
      } else {
        facts.longest_drive = std::max(facts.longest_drive, base::secondsBetween(begin, end));
      }
    }
    return facts;
  }

  bool isRest(base::Stamp begin, base::Stamp end) const {
    constexpr double kStayed = 1.5, kFaced = 1;  // [m] [rad]
    bool is_measured = false;
    for (const auto& [label, odometry] : odometry_) {
      const auto motion = odometry.between(begin, end);
      if (motion && (motion->norm() > kStayed || std::abs(motion->phi()) > kFaced)) return false;
      is_measured = is_measured || motion;
    }
    return is_measured;
  }

  // Adds the comparison of a laser with an odometry, which may be none, and the sweep of the laser.
  void compare(const std::string& label, const Laser& laser, const std::string& odometry,
               const OdometryStatistics* statistics, LogFacts& facts) const {
    const auto between = [&](base::Stamp begin, base::Stamp end) {
      return statistics ? statistics->between(begin, end) : std::nullopt;
    };
    const auto& pairs = laser.pairs.pairs();
    auto& scans = facts.scans.at(label);
    auto compared = compareMotions(pairs, scans.aperture, between, statistics ? statistics->headings() : Headings());
    compared.facts.laser = label;
    compared.facts.odometry = odometry;
    compared.facts.tried = pairs.size();
    if (!compared.facts.aperture) {
      const auto sweep = fitSweep(pairs, compared.motions, ini_.sweep);
      if (sweep && (!scans.sweep || sweep->sigma < scans.sweep->sigma)) scans.sweep = sweep;
    }
    // The turn of a scan is that of the middle of its sweep, and its stamp that of the beginning.
    const double middle = 0.5 * sweepOf(scans);
    if (facts.motions.empty() || facts.motions.back().laser != label) {
      for (const auto& [gyroscope, turned] : gyroscopes_) {
        auto clock = turned.stamps.empty() ? std::nullopt : fitClock(turnsOf(compared.motions), turned.headings());
        if (clock) clock->offset -= middle;
        facts.gyroscopes.push_back({gyroscope, label, clock});
      }
    }
    const auto& clock = compared.facts.clock;
    const auto late = base::durationFromSeconds(clock && clock->isWrong() ? clock->offset : 0);
    const auto at_scans = [&](base::Stamp begin, base::Stamp end) { return between(begin + late, end + late); };
    const double limit = saturates(scans) ? 0.99 * scans.longest : std::min(scans.max_range, ini_.max_range);
    if (!scans.constant_ahead) scans.constant_ahead = constantRangeAhead(pairs, at_scans, limit);
    // A laser that is turned against its declared pose looks at walls beside the robot instead of ahead.
    if (const auto& mounting = compared.facts.mounting) {
      constexpr double kTurned = 10 * base::option_text::kRadiansPerDegree, kSure = 0.3 * kTurned, kSame = 0.1;
      if (std::abs(mounting->yaw) > kTurned && mounting->yaw_sigma < kSure && std::abs(mounting->scale - 1) < kSame)
        scans.constant_ahead.reset();
    }
    if (compared.facts.clock) compared.facts.clock->offset -= middle;
    facts.motions.push_back(std::move(compared.facts));
  }

  // [s] as measured if it is declared wrong.
  double sweepOf(const ScanFacts& scans) const {
    return scans.sweep && scans.sweep->isWrong() ? std::max(0.0, scans.sweep->sweep) : ini_.sweep;
  }

  static double coveredShare(const Laser& laser, const OdometryStatistics& odometry) {
    if (laser.stamps.empty()) return 0;
    const auto covered = std::count_if(laser.stamps.begin(), laser.stamps.end(),
                                       [&](base::Stamp stamp) { return odometry.between(stamp, stamp).has_value(); });
    return static_cast<double>(covered) / static_cast<double>(laser.stamps.size());
  }

  IniFacts ini_;
  std::map<std::pair<std::string, std::string>, StampStatistics> stamps_;
  std::map<std::string, OdometryStatistics> odometry_;
  std::map<std::string, Gyroscope> gyroscopes_;
  std::map<std::string, PoseStatistics> poses_;
  LevelStatistics level_;
  ImageSizes sizes_;
  std::map<std::string, SampledImages> images_;  // by label
  std::map<std::string, Laser> lasers_;
  StreamClock clock_;
  std::map<std::pair<std::string, std::string>, source::LeftOut> uncalibrated_;  // as LogFacts::unusable
};

Declared Declared::read(const base::Config& config) {
  Declared declared;
  declared.sensor_poses = mapper::SensorPoses(config.section("mapper").read<mapper::EngineOptions>().sensors, config);
  auto& ini = declared.ini;
  ini.clock_offsets = declared.sensor_poses.clockOffsets();
  const auto read = [&](const std::string& section, const std::string& key, double& value) {
    std::string text;
    if (config.has(section) && config.section(section).find(key, text))
      base::option_text::parse(text, base::Range::notNegative(), value);
  };
  read("scan_odometry", "sweep_s", ini.sweep);
  read("laser_points", "max_range_m", ini.max_range);
  read("planes", "noise_at_1m_m", ini.depth_noise);
  if (!config.has("calibration")) return declared;
  const auto calibration = config.section("calibration").read<camera::CameraCalibrationOptions>();
  ini.has_calibration = true;
  ini.calibrated = calibration.label;
  ini.depth_scale = calibration.depth_scale.value_or(1);
  ini.mirrored = calibration.mirrored;
  ini.depth_is_range = calibration.depth_is_range;
  return declared;
}

FactGatherer::FactGatherer(Declared declared)
    : statistics_(std::make_unique<Statistics>(std::move(declared.ini))),
      sensor_poses_(std::move(declared.sensor_poses)) {}
FactGatherer::~FactGatherer() = default;

void FactGatherer::add(const mrpt::obs::CObservation::Ptr& observation) {
  statistics_->add(sensor_poses_.applied(observation));
}

LogFacts FactGatherer::facts() const {
  return statistics_->facts();
}

LogFacts gatherFacts(source::ObservationSource& log, const Declared& declared, const std::function<bool()>& stop,
                     base::Progress* progress) {
  FactGatherer gatherer(declared);
  while (!stop()) {
    const auto observation = log.next();
    if (!observation) break;
    gatherer.add(observation);
    if (progress) progress->report(log.progress(), "reading the log");
  }
  if (stop()) return {};
  auto facts = gatherer.facts();
  auto report = log.report();
  facts.unusable.merge(report.unusable);
  facts.missing_images = report.missing_images;
  facts.first_missing_image = report.first_missing_image;
  return facts;
}

}  // namespace omnimapper::check
