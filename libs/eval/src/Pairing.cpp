#include <omnimapper/base/Error.h>
#include <omnimapper/eval/Pairing.h>

namespace omnimapper::eval {

namespace {
std::string spanOf(const Trajectory& trajectory) {
  if (trajectory.empty()) return "holds no pose";
  return "spans " + base::formatUnix(trajectory.front().stamp) + " to " + base::formatUnix(trajectory.back().stamp);
}
}  // namespace

PairedTrajectories pairTrajectories(const Trajectory& estimate, const Trajectory& reference,
                                    const PairingOptions& options) {
  PairedTrajectories result;
  result.pairs = options.longest_gap > base::Duration(0)
                     ? associateInterpolated(estimate, reference, options.longest_gap)
                     : associate(estimate, reference, options.tolerance);
  if (result.pairs.empty()) {
    throw base::Error(base::ExitCode::unreadable_input,
                      "no pose of the estimate can be paired with one of the reference: the estimate " +
                          spanOf(estimate) + ", the reference " + spanOf(reference) +
                          "; are they of the same log, or is the tolerance too small?");
  }
  result.unpaired = estimate.size() - result.pairs.size();
  result.reference_from_estimate = fitAlignment(result.pairs, options.alignment);
  result.pairs = aligned(std::move(result.pairs), result.reference_from_estimate);
  return result;
}

}  // namespace omnimapper::eval
