#pragma once

#include <omnimapper/source/ObservationSource.h>

#include <memory>
#include <vector>

namespace omnimapper::source {

/// Merges several sources by stamp. The order within each source is kept: an observation without a stamp, or with a
/// stamp that runs backwards, comes right after the observation before it. Of observations with equal stamps, the one
/// of the source that is earlier in the list comes first.
class MergedSource : public ObservationSource {
 public:
  explicit MergedSource(std::vector<std::unique_ptr<ObservationSource>> sources);

  mrpt::obs::CObservation::Ptr next() override;
  /// The mean progress of all sources.
  double progress() const override;
  /// The sum of all counts, with the worst ending. Once all sources have ended, has_logs_apart is set if one source
  /// lies a minute or more from all others in time.
  SourceReport report() const override;
  void interrupt() override;

 private:
  struct Input {
    std::unique_ptr<ObservationSource> source;
    mrpt::obs::CObservation::Ptr head;
    base::Stamp latest;  // latest stamp up to the head
  };
  static void advance(Input& input);
  std::vector<Input> inputs_;
  bool is_started_ = false;
};

}  // namespace omnimapper::source
