#pragma once

#include <omnimapper/live/Journal.h>
#include <omnimapper/source/ObservationGate.h>
#include <omnimapper/source/ReadAhead.h>

#include <optional>

#include "run/Feed.h"

namespace omnimapper::mapper {

/// A journal and the position of its replay.
struct ReplayCursor {
  live::Journal journal;
  std::size_t next = 0;       ///< index of the next event
  bool has_departed = false;  ///< the engine does not act as the journal says any more

  bool isNext(live::JournalEvent::Kind kind) const {
    return next < journal.events.size() && journal.events[next].kind == kind;
  }
};

/// Uses the results of the workers as the journal says. After the run has departed from it, works as on a log.
class ReplaySchedule : public Schedule {
 public:
  explicit ReplaySchedule(std::shared_ptr<ReplayCursor> cursor) : cursor_(std::move(cursor)) {}

 private:
  bool takesBundleBeforeEnd(const FrameBundle& oldest, std::size_t waiting) override;
  bool takesJobBeforeEnd(bool is_due, bool is_done) override;
  bool takes(live::JournalEvent::Kind kind);

  std::shared_ptr<ReplayCursor> cursor_;
};

/// Passes the recording of a live run to the engine in the order in which it was mapped, so that the map is the same,
/// byte for byte.
class ReplayFeed : public Feed {
 public:
  /// `ini` is the text of this run's settings, which should be those of the live run.
  ReplayFeed(std::string journal, std::string ini) : path_(std::move(journal)), ini_(std::move(ini)) {}

  std::string title() const override;
  std::string name() const override { return path_; }
  std::string keepsRunIn(const std::string& folder) const override;
  std::vector<std::string> inputs() const override;
  std::unique_ptr<Schedule> schedule() override;
  void open(const Stop& stop) override;
  bool feed(Engine& engine, SensorSamples& samples, base::Progress& progress, const Stop& stop) override;
  source::SourceReport report() const override;

 private:
  void openFile(const Stop& stop);
  mrpt::obs::CObservation::Ptr read(std::uint64_t number, const Stop& stop);
  void depart(Engine& engine);
  void mapWhatIsLeft(Engine& engine, SensorSamples& samples, const Stop& stop);
  void changePlugins(std::uint64_t number, Engine& engine);
  void warnOfOtherSettings(Engine& engine);

  std::string path_, ini_;
  std::shared_ptr<ReplayCursor> cursor_ = std::make_shared<ReplayCursor>();
  std::size_t file_ = 0;                 // index of the rawlog being read
  std::uint64_t next_ = 0;               // number of the next observation to read
  std::uint64_t first_unmentioned_ = 0;  // number of the first observation that no event so far has mentioned
  // Unusable observations are found over the whole recording, as in the live run.
  std::shared_ptr<source::ObservationGate> gate_ = std::make_shared<source::ObservationGate>();
  std::optional<source::ReadAhead> log_;  // the rawlog file_
  source::SourceReport of_earlier_;       // report on the files before file_
  bool ended_early_ = false, has_other_settings_ = false;
};

}  // namespace omnimapper::mapper
