#include "CalibrationReport.h"

#include <omnimapper/base/Config.h>
#include <omnimapper/base/Numbers.h>
#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/geometry/OpticalFrame.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <nlohmann/json.hpp>
#include <sstream>

#include "Outputs.h"

namespace omnimapper::calibration {

namespace {

using base::brief;
using base::fixed;

std::string nameOf(Group group, bool one_camera) {
  const std::string of = one_camera ? "of both images" : "of the picture";
  switch (group) {
    case Group::focal:
      return "focal length " + of;
    case Group::centre:
      return "centre " + of;
    case Group::lens:
      return "lens " + of;
    case Group::depth_focal:
      return "focal length of the depths";
    case Group::depth_centre:
      return "centre of the depths";
    case Group::place:
      return "position of the picture's camera in the depth camera's optical frame";
    case Group::turn:
      return "rotation of the picture's camera in that frame (rotation vector)";
    case Group::scale:
      return "scale of the depths";
    case Group::timing:
      return "readout times";
  }
  return "";
}

int decimalsOf(const std::string& key) {
  if (key.size() > 3 && key.compare(key.size() - 3, 3, "_px") == 0) return 2;
  return key.size() > 4 && key.compare(key.size() - 4, 4, "_deg") == 0 ? 3 : 4;
}

bool isDetermined(const Calibration& calibration, Group group) {
  for (const auto& result : calibration.groups)
    if (result.group == group) return result.is_determined;
  return false;
}

void writeCamera(std::ostream& out, const std::string& prefix, const Intrinsics& camera, bool focal, bool centre,
                 bool lens) {
  static const char* const keys[] = {"fx_px", "fy_px", "cx_px", "cy_px", "k1", "k2", "p1", "p2", "k3"};
  for (std::size_t i = 0; i < camera.size(); ++i) {
    const bool is_written = i < 2 ? focal : i < 4 ? centre : lens;
    if (is_written) out << prefix << "_" << keys[i] << " = " << brief(camera[i], 8) << "\n";
  }
}

void writePose(std::ostream& out, const DepthCamera& camera) {
  const auto pose = geometry::toMrpt(geometry::sensorFromOptical() * camera.depth_from_picture);
  constexpr double kDegree = base::option_text::kRadiansPerDegree;
  out << "picture_x_m = " << brief(pose.x(), 8) << "\npicture_y_m = " << brief(pose.y(), 8)
      << "\npicture_z_m = " << brief(pose.z(), 8) << "\npicture_yaw_deg = " << brief(pose.yaw() / kDegree, 10)
      << "\npicture_pitch_deg = " << brief(pose.pitch() / kDegree, 10)
      << "\npicture_roll_deg = " << brief(pose.roll() / kDegree, 10) << "\n";
}

std::string verdictOf(const Calibration& calibration) {
  if (calibration.after.corners == 0)
    return "the held-back views show too few corners to test it: the log's calibration holds, and "
           "calibration.ini changes nothing; record more of the same places";
  if (!calibration.is_better)
    return "the held-back views fit no better: the log's calibration holds, and calibration.ini changes "
           "nothing";
  return "the held-back views fit better: calibration.ini has the values that are determined";
}

void writeHeldBack(std::ostream& out, const std::string& name, const HeldBack& held) {
  out << "  " << std::left << std::setw(10) << name << "corners " << fixed(held.pixel_median, 3)
      << " px in the median, " << fixed(held.pixel_rms, 3) << " px rms; depths " << fixed(1000 * held.depth_rms, 2)
      << " mm rms at 1 m; cost " << fixed(held.cost, 4) << "\n";
}

}  // namespace

std::string calibrationIni(const Calibration& calibration, const CalibrationLog& log, const std::string& title) {
  const auto& camera = calibration.is_better ? calibration.estimate : calibration.log;
  std::ostringstream out;
  out << base::kWrittenFromALog << ", " << title << ", by omnimapper-calibrate; report.txt says how well.\n"
      << "; omnimapper-graphslam -i INI -i calibration.ini -r LOG -o FOLDER\n"
      << "[calibration]\n"
      << labelLine(log.label);
  // The values of the request's INI are written again, so that this INI is complete without it.
  const bool writes_all = log.is_corrected;
  out << distortionLine(log.depth_distortion);
  if (!calibration.is_better && !writes_all) return out.str();
  const auto is_written = [&](Group group) { return writes_all || isDetermined(calibration, group); };
  const bool focal = is_written(Group::focal), centre = is_written(Group::centre), lens = is_written(Group::lens);
  writeCamera(out, "picture", camera.picture, focal, centre, lens);
  if (camera.is_registered) {
    writeCamera(out, "depth", camera.picture, focal, centre, lens);
  } else {
    writeCamera(out, "depth", camera.depth, is_written(Group::depth_focal), is_written(Group::depth_centre),
                writes_all);
  }
  if (!camera.is_registered && (is_written(Group::place) || is_written(Group::turn))) writePose(out, camera);
  if (is_written(Group::scale)) out << "depth_scale = " << brief(log.corrected_scale * camera.depth_scale, 8) << "\n";
  return out.str();
}

std::string reportText(const Calibration& calibration, const CalibrationLog& log, const std::string& title) {
  std::ostringstream out;
  out << (log.is_part ? "only the beginning of the log was needed; --start takes another part, --views more of it\n"
                      : "")
      << "calibration of '" << log.label << "' from " << title << "\n"
      << base::counted(log.images, "image") << " over " << fixed(log.travel, 1) << " m and "
      << fixed(log.turn / base::option_text::kRadiansPerDegree, 0) << " deg of rotation, tracking lost in " << log.lost
      << "; " << base::counted(calibration.views, "view") << ", of which " << calibration.held_views << " held back; "
      << base::counted(calibration.corners, "corner") << " of " << base::counted(calibration.tracks, "point") << ", "
      << calibration.surfaces << " with depth\n"
      << (calibration.log.is_registered ? "depths are registered to the picture: one camera\n"
                                        : "depths and picture are from two cameras\n");
  if (calibration.spans > 0)
    out << base::counted(calibration.spans, "distance") << " in metres, from "
        << (log.are_wheels ? "wheels" : "given poses") << "\n";
  out << "\n"
      << std::left << std::setw(20) << "" << std::setw(12) << "log" << std::setw(12) << "estimate"
      << "standard deviation\n";
  for (const auto& result : calibration.groups) {
    out << nameOf(result.group, calibration.log.is_registered) << "\n";
    for (const auto& number : result.numbers) {
      const int decimals = decimalsOf(number.key);
      out << "  " << std::setw(18) << number.key << std::setw(12) << fixed(number.log, decimals);
      if (result.is_determined || number.sigma > 0)
        out << std::setw(12) << fixed(number.estimate, decimals) << "+- " << brief(number.sigma, 2);
      out << "\n";
    }
    if (!result.is_determined) out << "  the log's value holds; " << result.why << "\n";
  }
  out << "\nheld-back views, of which only the poses were fitted (" << calibration.after.corners << " corners):\n";
  writeHeldBack(out, "before", calibration.before);
  writeHeldBack(out, "after", calibration.after);
  out << "verdict: " << verdictOf(calibration) << "\n";
  return out.str();
}

std::string summaryJson(const Calibration& calibration, const CalibrationLog& log) {
  nlohmann::ordered_json json;
  json["label"] = log.label;
  json["images"] = log.images;
  json["images_lost"] = log.lost;
  json["travel_m"] = log.travel;
  json["turn_rad"] = log.turn;
  json["is_one_camera"] = calibration.log.is_registered;
  json["views"] = calibration.views;
  json["views_held_back"] = calibration.held_views;
  json["points"] = calibration.tracks;
  json["corners"] = calibration.corners;
  json["depths"] = calibration.surfaces;
  json["distances_in_metres"] = calibration.spans;
  for (const auto& result : calibration.groups) {
    nlohmann::ordered_json one;
    one["name"] = nameOf(result.group, calibration.log.is_registered);
    one["is_determined"] = result.is_determined;
    if (!result.is_determined) one["why"] = result.why;
    for (const auto& number : result.numbers)
      one["values"].push_back(
          {{"key", number.key}, {"log", number.log}, {"estimate", number.estimate}, {"sigma", number.sigma}});
    json["parameters"].push_back(one);
  }
  const auto held = [](const HeldBack& h) {
    return nlohmann::ordered_json{{"corners", h.corners},
                                  {"pixel_median_px", h.pixel_median},
                                  {"pixel_rms_px", h.pixel_rms},
                                  {"depth_rms_per_m", h.depth_rms},
                                  {"cost", h.cost}};
  };
  json["held_back_before"] = held(calibration.before);
  json["held_back_after"] = held(calibration.after);
  json["is_better"] = calibration.is_better;
  json["verdict"] = verdictOf(calibration);
  return json.dump(2) + "\n";
}

}  // namespace omnimapper::calibration
