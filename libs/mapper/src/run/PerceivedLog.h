#pragma once

#include <omnimapper/mapper/PerceptionRun.h>
#include <omnimapper/source/RawlogWriter.h>

#include <optional>
#include <vector>

#include "ExtractionErrors.h"

namespace omnimapper::mapper {

/// What one extractor made of one observation, or why it could not.
struct Outcome {
  bool wanted = false;
  std::vector<mrpt::obs::CObservation::Ptr> derived;
  std::optional<base::Error> error;
};

/// The log that a run of perception writes, and what is to be said about it.
class PerceivedLog {
 public:
  PerceivedLog(const PerceptionRequest& request, source::RawlogWriter& rawlog, PerceptionResult& result)
      : request_(request), rawlog_(rawlog), result_(result) {}

  /// What was read, in its order, with one outcome an extractor. Observations of one stamp are written together.
  void add(const mrpt::obs::CObservation::Ptr& raw, std::vector<Outcome> outcomes);
  /// After the last one. Throws the first error of an extractor if none made anything of what it wanted.
  void finish();

 private:
  struct Entry {
    mrpt::obs::CObservation::Ptr raw;
    std::vector<Outcome> outcomes;
  };
  void writeMoment();
  void write(Outcome& outcome, const mrpt::obs::CObservation& raw, PerceptionResult::Count& count);
  bool bringsAlready(const mrpt::obs::CObservation& derived) const;
  bool isWritten(const mrpt::obs::CObservation& derived) const;
  void warn();

  const PerceptionRequest& request_;
  source::RawlogWriter& rawlog_;
  PerceptionResult& result_;
  std::vector<Entry> moment_;                          // of one stamp
  std::vector<mrpt::obs::CObservation::Ptr> written_;  // what was derived of it
  ExtractionErrors errors_;
  bool has_succeeded_ = false;
  std::size_t in_log_ = 0, repeated_ = 0;
  std::string first_repeated_;
};

}  // namespace omnimapper::mapper
