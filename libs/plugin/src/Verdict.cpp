#include <omnimapper/plugin/Verdict.h>

#include <algorithm>
#include <utility>

namespace omnimapper::mapper {

Verdict conclude(std::vector<Evidence> all) {
  std::vector<Evidence> evidence;
  for (Evidence& one : all) {
    const auto same =
        std::find_if(evidence.begin(), evidence.end(), [&](const Evidence& other) { return other.name == one.name; });
    if (same == evidence.end()) {
      evidence.push_back(std::move(one));
    } else if (same->says == Evidence::Says::too_little) {
      *same = std::move(one);
    } else if (one.says != Evidence::Says::too_little) {
      evidence.push_back(std::move(one));
    }
  }
  const auto any = [&](Evidence::Says says) {
    return std::any_of(evidence.begin(), evidence.end(), [&](const Evidence& one) { return one.says == says; });
  };
  Verdict verdict;
  if (any(Evidence::Says::against_it)) {
    verdict.answer = Verdict::Answer::suspicious;
  } else if (!evidence.empty() && !any(Evidence::Says::too_little)) {
    verdict.answer = Verdict::Answer::consistent;
  }
  verdict.evidence = std::move(evidence);
  return verdict;
}

std::string toString(Verdict::Answer answer) {
  switch (answer) {
    case Verdict::Answer::consistent:
      return "consistent";
    case Verdict::Answer::suspicious:
      return "suspicious";
    case Verdict::Answer::cannot_tell:
      break;
  }
  return "cannot tell";
}

std::string sentenceOf(const Verdict& verdict) {
  const auto reasons = [&](Evidence::Says says) {
    std::string text;
    for (const auto& one : verdict.evidence) {
      if (one.says == says && !one.reason.empty()) text += (text.empty() ? "" : "; ") + one.reason;
    }
    return text;
  };
  switch (verdict.answer) {
    case Verdict::Answer::consistent:
      return "The map is consistent: " + reasons(Evidence::Says::good) + ".";
    case Verdict::Answer::suspicious:
      return "The map is suspicious: " + reasons(Evidence::Says::against_it) + ".";
    case Verdict::Answer::cannot_tell:
      break;
  }
  const std::string why = reasons(Evidence::Says::too_little);
  return "The run cannot tell whether the map is right: " + (why.empty() ? "no plugin checks maps" : why) + ".";
}

}  // namespace omnimapper::mapper
