#pragma once

#include <omnimapper/mapper/PerceptionRun.h>
#include <omnimapper/source/RawlogWriter.h>

#include <string>
#include <vector>

#include "ExtractionErrors.h"
#include "run/PerceptionLine.h"

namespace omnimapper::mapper {

/// Writes the log of a run of perception and collects the warnings about it.
class PerceivedLog {
 public:
  PerceivedLog(const PerceptionRequest& request, source::RawlogWriter& rawlog, PerceptionResult& result)
      : request_(request), rawlog_(rawlog), result_(result) {}

  /// Must be called in the order of the input log. Observations of one stamp are written together.
  void add(PerceptionLine::Perceived perceived);
  /// Must be called after the last observation. Throws the first error if no extractor succeeded on any observation
  /// that it wanted.
  void finish();

 private:
  using Entry = PerceptionLine::Perceived;
  void writeGroup();
  void write(Outcome& outcome, const mrpt::obs::CObservation& raw, PerceptionResult::Count& count);
  bool bringsAlready(const mrpt::obs::CObservation& derived) const;
  bool isWritten(const mrpt::obs::CObservation& derived) const;
  void warn();

  const PerceptionRequest& request_;
  source::RawlogWriter& rawlog_;
  PerceptionResult& result_;
  std::vector<Entry> group_;                           // observations of one stamp
  std::vector<mrpt::obs::CObservation::Ptr> written_;  // derived observations of that stamp
  ExtractionErrors errors_;
  bool has_succeeded_ = false;
  std::size_t in_log_ = 0, repeated_ = 0;
  std::string first_repeated_;
};

}  // namespace omnimapper::mapper
