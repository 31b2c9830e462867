#pragma once

#include <omnimapper/mapper/PerceptionRun.h>
#include <omnimapper/source/RawlogWriter.h>

#include <string>
#include <vector>

#include "ExtractionErrors.h"
#include "run/PerceptionLine.h"

namespace omnimapper::mapper {

/// The log that a run of perception writes, and what is to be said about it.
class PerceivedLog {
 public:
  PerceivedLog(const PerceptionRequest& request, source::RawlogWriter& rawlog, PerceptionResult& result)
      : request_(request), rawlog_(rawlog), result_(result) {}

  /// In the order of what was read. Observations of one stamp are written together.
  void add(PerceptionLine::Perceived perceived);
  /// After the last one. Throws the first error of an extractor if none made anything of what it wanted.
  void finish();

 private:
  using Entry = PerceptionLine::Perceived;
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
