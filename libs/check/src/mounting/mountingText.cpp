#include "mountingText.h"

#include <omnimapper/base/Numbers.h>

#include <cmath>
#include <cstdio>

#include "../Format.h"

namespace omnimapper::check {

namespace {

using State = Quantity::State;

std::string rowOf(const Quantity& quantity) {
  const std::string declared = quantity.words.empty() ? quantity.declaredText() : "";
  const std::string measured = quantity.measuredText();
  char row[400];
  std::snprintf(row, sizeof row, "%-14s %-17s %12s   %-24s %-11s  %s\n", check::quoted(quantity.sensor).c_str(),
                quantity.name.c_str(), declared.c_str(), measured.c_str(),
                quantity.state == State::corrected ? "CORRECTED" : "as declared", quantity.reason.c_str());
  return row;
}

}  // namespace

std::string Quantity::declaredText() const {
  return base::fixed(declared, decimals) + (unit.empty() ? "" : " " + unit);
}

std::string Quantity::measuredText() const {
  if (!words.empty()) return words;
  const std::string value = base::fixed(measured.value, decimals), sigma = sigmaText();
  return sigma.empty() ? value + (unit.empty() ? "" : " " + unit) : value + " " + sigma;
}

std::string Quantity::sigmaText() const {
  if (!(measured.sigma > 0)) return "";
  // A standard deviation is never written as zero.
  const bool is_seen = measured.sigma > 0.5 * std::pow(10.0, -decimals);
  return "+- " + (is_seen ? base::fixed(measured.sigma, decimals) : base::brief(measured.sigma, 1)) +
         (unit.empty() ? "" : " " + unit);
}

std::string mountingText(const std::string& title, const SensorMounting& mounting,
                         const std::vector<std::string>& left_out, const std::vector<std::string>& contradictions) {
  char heading[200];
  std::snprintf(heading, sizeof heading, "%-14s %-17s %12s   %-24s\n", "sensor", "quantity", "declared", "measured");
  std::string measured, not_determined, text = title + ": how its sensors are mounted, by what they measured\n\n";
  for (const auto& one : mounting.quantities) {
    if (one.state == State::as_declared || one.state == State::corrected) measured += rowOf(one);
    if (one.state == State::not_determined)
      not_determined += "  " + check::quoted(one.sensor) + " " + one.name + ": " + one.reason + "\n";
  }
  if (!measured.empty()) text += heading + measured;
  if (!not_determined.empty()) text += "\nNot determined by this log:\n" + not_determined;
  for (const auto& causes : mounting.two_causes) text += "\nTWO CAUSES  " + causes.text + "\n";
  for (const auto& sentence : left_out) text += "\n" + sentence + ".\n";
  if (!contradictions.empty()) text += "\nThe log still contradicts what is declared:\n";
  for (const auto& sentence : contradictions) text += "PROBLEM  " + sentence + "\n";
  return text;
}

}  // namespace omnimapper::check
