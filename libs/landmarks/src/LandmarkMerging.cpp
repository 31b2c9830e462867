#include <omnimapper/landmarks/LandmarkMerging.h>

namespace omnimapper::landmarks {

mapper::Decision mergeDecision(const mapper::View& view, const std::string& section, base::LandmarkId kept,
                               base::LandmarkId gone, const Sameness& sameness) {
  mapper::Decision decision(view.map.key_frames.back(), section, "merge");
  decision.accepted = true;
  decision.reason = "two landmarks are the same" + (sameness.why.empty() ? "" : ": " + sameness.why);
  decision.numbers = {
      {"landmark", kept.index}, {"other", gone.index}, {"chi-square", sameness.chi2}, {"limit", sameness.limit}};
  return decision;
}

}  // namespace omnimapper::landmarks
