#pragma once

#include <omnimapper/live/Journal.h>
#include <omnimapper/source/ObservationGate.h>
#include <omnimapper/source/ReadAhead.h>

#include <optional>

#include "run/Feed.h"

namespace omnimapper::mapper {

/// A journal that is followed, event by event.
struct ReplayCursor {
  live::Journal journal;
  std::size_t next = 0;       ///< event
  bool has_departed = false;  ///< what the engine did is not what the journal says

  bool isNext(live::JournalEvent::Kind kind) const {
    return next < journal.events.size() && journal.events[next].kind == kind;
  }
};

/// Takes what the journal says was taken. Where the run departs from it, goes on as on a log.
class ReplaySchedule : public Schedule {
 public:
  explicit ReplaySchedule(std::shared_ptr<ReplayCursor> cursor) : cursor_(std::move(cursor)) {}

 private:
  bool takesBundleBeforeEnd(const FrameBundle& oldest, std::size_t waiting) override;
  bool takesJobBeforeEnd(bool is_due, bool is_done) override;
  bool takes(live::JournalEvent::Kind kind);

  std::shared_ptr<ReplayCursor> cursor_;
};

/// What a live run recorded, given to the engine in the order in which it was mapped: the map is the same, byte for
/// byte.
class ReplayFeed : public Feed {
 public:
  /// `ini`: the settings of this run, which should be those of the live run.
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
  void warnOfOtherSettings(Engine& engine) const;

  std::string path_, ini_;
  std::shared_ptr<ReplayCursor> cursor_ = std::make_shared<ReplayCursor>();
  std::size_t file_ = 0;    // that is read
  std::uint64_t next_ = 0;  // observation to be read
  std::uint64_t told_ = 0;  // the first of which the journal has said nothing yet
  // What is usable is judged over the whole recording, as it was live.
  std::shared_ptr<source::ObservationGate> gate_ = std::make_shared<source::ObservationGate>();
  std::optional<source::ReadAhead> log_;  // of that file
  source::SourceReport of_earlier_;       // files
  bool ended_early_ = false;
};

}  // namespace omnimapper::mapper
