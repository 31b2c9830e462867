#include <omnimapper/landmarks/LandmarkMerging.h>

namespace omnimapper::landmarks {

mapper::Decision mergeDecision(const mapper::View& view, const std::string& section, base::LandmarkId kept,
                               base::LandmarkId gone, const Sameness& sameness) {
  mapper::Decision decision;
  decision.stamp = view.map.key_frames.back().stamp;
  decision.plugin = section;
  decision.kind = "merge";
  decision.from = view.map.key_frames.back().id;
  decision.accepted = true;
  decision.reason = "two landmarks are the same" + (sameness.why.empty() ? "" : ": " + sameness.why);
  decision.numbers = {
      {"landmark", kept.index}, {"other", gone.index}, {"chi-square", sameness.chi2}, {"limit", sameness.limit}};
  return decision;
}

}  // namespace omnimapper::landmarks
