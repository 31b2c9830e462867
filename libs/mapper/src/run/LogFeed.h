#pragma once

#include <omnimapper/source/ReadAhead.h>
#include <omnimapper/source/SourceOptions.h>

#include <optional>

#include "run/Feed.h"

namespace omnimapper::mapper {

/// Reads logs, merged by stamp, as fast as they can be mapped or at a given pace.
class LogFeed : public Feed {
 public:
  LogFeed(const RunRequest& request, source::SourceOptions options)
      : logs_(request.logs), speed_(request.speed), watch_(request.watch), options_(std::move(options)) {}

  std::string title() const override;
  std::string name() const override;
  std::vector<std::string> inputs() const override { return logs_; }
  void open(const Stop& stop) override;
  bool feed(Engine& engine, SensorSamples& samples, base::Progress& progress, const Stop& stop) override;
  source::SourceReport report() const override { return log_->report(); }

 private:
  std::vector<std::string> logs_;
  double speed_;  // relative to the log's own pace; 0: as fast as possible
  std::shared_ptr<InputWatch> watch_;
  source::SourceOptions options_;
  std::optional<source::ReadAhead> log_;
};

}  // namespace omnimapper::mapper
