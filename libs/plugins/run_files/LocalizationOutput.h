#pragma once

#include <omnimapper/plugin/PluginFactory.h>

#include <memory>
#include <string>

namespace omnimapper::plugins {

struct LocalizationOptions {
  static const base::OptionTable<LocalizationOptions>& table();
};

/// Writes localization.csv: the pose of the base at each key frame, estimated without later data. Each line is
/// "stamp,x_m,y_m,z_m,yaw_deg,pitch_deg,roll_deg,sigma_x_m,sigma_y_m,sigma_yaw_deg,located" with Unix time [s]. Sigmas
/// are along the map's axes, empty if a direction is undetermined; located is 0 or 1 (mapper::LocalizationEstimate).
class LocalizationOutput : public mapper::OutputPlugin {
 public:
  static constexpr const char* kName = "LocalizationOutput";
  static constexpr const char* kSummary =
      "With --localize, writes localization.csv: the pose of each key frame as estimated when the key frame was "
      "made, with its standard deviations.";

  LocalizationOutput(const LocalizationOptions& options, const mapper::PluginContext& context);
  void finish(const mapper::View& view) override;

 private:
  std::string path_;
};

}  // namespace omnimapper::plugins
