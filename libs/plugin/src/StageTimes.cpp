#include <omnimapper/plugin/StageTimes.h>

namespace omnimapper::mapper {

void StageTimes::add(const std::string& stage, double seconds) {
  auto& total = totals_[stage];
  total.seconds += seconds;
  ++total.calls;
}

}  // namespace omnimapper::mapper
