#pragma once

#include <omnimapper/source/ObservationSource.h>

#include <memory>
#include <vector>

namespace omnimapper::source {

/// Several sources as one, sorted by stamp. The order within each source is kept as it is: an observation whose stamp
/// runs backwards, or that has none, comes right after the one before it. Equal stamps: the earlier source first.
class MergedSource : public ObservationSource {
 public:
  explicit MergedSource(std::vector<std::unique_ptr<ObservationSource>> sources);

  mrpt::obs::CObservation::Ptr next() override;
  /// Of all sources together, each weighing the same.
  double progress() const override;
  /// The sum; the worst ending. has_logs_apart if one lies a minute or more from all others, once all have ended.
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
