#include "LocalizationOutput.h"

#include <omnimapper/base/Numbers.h>
#include <omnimapper/derived/OutputFile.h>

#include <cmath>

namespace omnimapper::plugins {

namespace {

std::string lineOf(const mapper::LocalizationEstimate& estimate) {
  constexpr double kDegrees = 1 / base::option_text::kRadiansPerDegree;
  const auto& pose = estimate.map_from_base;
  std::string line = base::formatUnix(estimate.stamp);
  for (const double metres : {pose.x(), pose.y(), pose.z()}) line += "," + base::fixed(metres, 4);
  for (const double angle : {pose.yaw(), pose.pitch(), pose.roll()}) line += "," + base::fixed(angle * kDegrees, 3);
  if (const auto position = estimate.positionCovariance()) {
    line += "," + base::fixed(std::sqrt((*position)(0, 0)), 4) + "," + base::fixed(std::sqrt((*position)(1, 1)), 4) +
            "," + base::fixed(std::sqrt((*estimate.covariance)(5, 5)) * kDegrees, 3);
  } else {
    line += ",,,";
  }
  return line + (estimate.located() ? ",1\n" : ",0\n");
}

}  // namespace

const base::OptionTable<LocalizationOptions>& LocalizationOptions::table() {
  static const base::OptionTable<LocalizationOptions> table;
  return table;
}

LocalizationOutput::LocalizationOutput(const LocalizationOptions&, const mapper::PluginContext& context)
    : path_(derived::outputPath(context, "localization.csv")) {}

void LocalizationOutput::finish(const mapper::View& view) {
  if (!view.map_is_held) return;
  std::string text = "stamp,x_m,y_m,z_m,yaw_deg,pitch_deg,roll_deg,sigma_x_m,sigma_y_m,sigma_yaw_deg,located\n";
  for (const auto& estimate : view.localization) text += lineOf(estimate);
  derived::writeBytes(path_, text);
}

}  // namespace omnimapper::plugins
