#pragma once

#include <omnimapper/base/Progress.h>
#include <omnimapper/check/LogFacts.h>
#include <omnimapper/mapper/SensorPoses.h>
#include <omnimapper/source/ObservationSource.h>

#include <functional>
#include <memory>

namespace omnimapper::check {

/// What an INI states about the sensors of a log.
struct Declared {
  mapper::SensorPoses sensor_poses;
  IniFacts ini;

  /// Reads `[mapper] sensors`, the sections that it names, and the keys of IniFacts.
  static Declared read(const base::Config& config);
};

/// Collects statistics on observations while they are read. Memory grows by some bytes for each observation; only some
/// thousand scans and some depth images are kept.
class FactGatherer {
 public:
  explicit FactGatherer(Declared declared);
  ~FactGatherer();
  /// Takes an observation as the source hands it out.
  void add(const mrpt::obs::CObservation::Ptr& observation);
  /// What was collected, without what only the source knows, such as missing images.
  LogFacts facts() const;

 private:
  class Statistics;
  std::unique_ptr<Statistics> statistics_;
  mapper::SensorPoses sensor_poses_;
};

/// Reads the stream to its end, or until `stop` returns true, and collects statistics on the observations.
LogFacts gatherFacts(
    source::ObservationSource& log, const Declared& declared = {},
    const std::function<bool()>& stop = [] { return false; }, base::Progress* progress = nullptr);

}  // namespace omnimapper::check
