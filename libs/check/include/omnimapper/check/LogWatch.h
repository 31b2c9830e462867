#pragma once

#include <omnimapper/base/Config.h>
#include <omnimapper/check/gatherFacts.h>
#include <omnimapper/mapper/MappingRun.h>

namespace omnimapper::check {

/// Checks a log while it is mapped. Problems where the observations contradict what the log or the INI declares of a
/// sensor are evidence against the map: one that was made with a mirrored laser or a wrong scale can be consistent.
class LogWatch : public mapper::InputWatch {
 public:
  explicit LogWatch(const base::Config& config) : gatherer_(Declared::read(config)) {}
  void add(const mrpt::obs::CObservation::Ptr& observation) override { gatherer_.add(observation); }
  Judgement judgement() override;

 private:
  FactGatherer gatherer_;
};

}  // namespace omnimapper::check
