#pragma once

#include <map>
#include <string>

namespace omnimapper::base {

/// Keys of INI files that have another name now, by the name they had.
inline const std::map<std::string, std::string>& renamedKeys() {
  static const std::map<std::string, std::string> keys{
      {"bend_at_1m_m", "distortion_at_1m_m"},
      {"context_m", "submap_length_m"},
      {"free_key_frames", "window_key_frames"},
      {"guess_sigma_deg", "prediction_sigma_deg"},
      {"guess_sigma_m", "prediction_sigma_m"},
      {"guess_sigma_per_m", "prediction_sigma_per_m"},
      {"join_way_m", "join_travel_m"},
      {"jump_share", "relative_jump"},
      {"lost_way_m", "lost_travel_m"},
      {"max_clock_off_s", "max_clock_offset_s"},
      {"max_surprise", "max_outlier_share"},
      {"min_sightings", "min_measurements"},
      {"min_way_m", "min_travel_m"},
      {"pixel_noise", "point_sigma_px"},
      {"sample_radius_m", "sample_cube_m"},
  };
  return keys;
}

}  // namespace omnimapper::base
