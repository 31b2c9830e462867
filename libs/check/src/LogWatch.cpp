#include <omnimapper/check/LogWatch.h>
#include <omnimapper/check/judge.h>

#include <algorithm>

namespace omnimapper::check {

namespace {

// The text without its remedies: up to the first semicolon or the end of the first sentence.
std::string whatOf(const std::string& text) {
  return text.substr(0, std::min(text.find("; "), text.find(". ")));
}

}  // namespace

mapper::InputWatch::Judgement LogWatch::judgement() {
  Judgement judgement;
  std::string reason;
  std::size_t count = 0;
  for (const auto& finding : judge(gatherer_.facts())) {
    if (!finding.is_contradiction || finding.weight == Weight::note) continue;
    judgement.warnings.push_back(finding.text);
    if (finding.weight != Weight::problem) continue;
    reason += (count++ == 0 ? "the log contradicts what it declares: " : "; ") + whatOf(finding.text);
  }
  // A log that declares nothing wrong says nothing about the map.
  if (count > 0)
    judgement.evidence.push_back(
        {"contradicted_declarations", static_cast<double>(count), mapper::Evidence::Says::against_it, reason});
  return judgement;
}

}  // namespace omnimapper::check
