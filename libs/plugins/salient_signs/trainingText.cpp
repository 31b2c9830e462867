#include <omnimapper/base/Numbers.h>

#include <algorithm>

#include "SignTraining.h"

namespace omnimapper::signs {

namespace {

std::string padded(std::string text, std::size_t width) {
  text.resize(std::max(width, text.size()), ' ');
  return text;
}

std::string ratesText(const SignRates& rates) {
  return base::fixed(rates.truePositive(), 3) + "  " + base::fixed(rates.trueNegative(), 3);
}

}  // namespace

std::string toText(const std::vector<RegionSet>& sets, const std::vector<SignTrial>& trials) {
  std::size_t width = 10;
  for (const SignTrial& trial : trials) width = std::max(width, trial.name.size());
  const auto name = [&](const std::string& text) { return padded(text, width + 2); };
  std::string text = "Regions\n" + name("building") + "pictures  signs  found  sign regions  other regions\n";
  for (const RegionSet& set : sets) {
    const auto signs = static_cast<std::size_t>(
        std::count_if(set.regions.begin(), set.regions.end(), [](const LabelledRegion& each) { return each.is_sign; }));
    text += name(set.name) + padded(std::to_string(set.pictures), 10) + padded(std::to_string(set.signs), 7) +
            padded(std::to_string(set.found), 7) + padded(std::to_string(signs), 14) +
            std::to_string(set.regions.size() - signs) + "\n";
  }
  text +=
      "\nCross-validation (thesis, Table 6)\n" + name("building") + "true positive  true negative  support vectors\n";
  for (const SignTrial& trial : trials) {
    text += name(trial.name) + padded(base::fixed(trial.cross_validated.truePositive(), 3), 15) +
            padded(base::fixed(trial.cross_validated.trueNegative(), 3), 15) + std::to_string(trial.vectors) + "\n";
  }
  text +=
      "\nTrained on, tested on (thesis, Table 7): true positive, true negative; cross-validated where both are the "
      "same\n" +
      name("trained on");
  for (const RegionSet& set : sets) text += padded(set.name, std::max<std::size_t>(14, set.name.size() + 2));
  text += "\n";
  for (const SignTrial& trial : trials) {
    text += name(trial.name);
    for (std::size_t i = 0; i < sets.size(); ++i)
      text += padded(ratesText(trial.across[i]), std::max<std::size_t>(14, sets[i].name.size() + 2));
    text += "\n";
  }
  return text;
}

}  // namespace omnimapper::signs
