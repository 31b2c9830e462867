#pragma once

#include <omnimapper/source/ObservationSource.h>

#include <vector>

namespace omnimapper::testing {

/// Hands out observations from memory. They must outlive it.
class MemorySource : public source::ObservationSource {
 public:
  explicit MemorySource(const std::vector<mrpt::obs::CObservation::Ptr>& observations) : observations_(observations) {}
  mrpt::obs::CObservation::Ptr next() override { return at_ < observations_.size() ? observations_[at_++] : nullptr; }
  double progress() const override { return 1; }
  source::SourceReport report() const override { return {}; }

 private:
  const std::vector<mrpt::obs::CObservation::Ptr>& observations_;
  std::size_t at_ = 0;
};

}  // namespace omnimapper::testing
