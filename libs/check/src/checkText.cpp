#include "checkText.h"

#include <algorithm>
#include <cstdio>

#include "Format.h"

namespace omnimapper::check {

namespace {

std::string shortName(const std::string& class_name) {
  const auto colon = class_name.rfind(':');
  return colon == std::string::npos ? class_name : class_name.substr(colon + 1);
}

std::string sensorTable(const LogFacts& facts) {
  char row[300];
  std::snprintf(row, sizeof row, "%-16s %-26s %8s %9s %10s %11s %9s\n", "sensor", "class", "count", "rate 1/s",
                "max gap s", "out of order", "no stamp");
  std::string text = row;
  for (const auto& [sensor, stamps] : facts.sensors) {
    std::snprintf(row, sizeof row, "%-16s %-26s %8zu %9s %10s %12zu %9zu\n",
                  sensor.first.empty() ? "(no label)" : sensor.first.c_str(), shortName(sensor.second).c_str(),
                  stamps.count, stamps.period > 0 ? fixed(1 / stamps.period, 1).c_str() : "-",
                  fixed(stamps.longest_gap, 2).c_str(), stamps.backward + stamps.repeated, stamps.no_stamp);
    text += row;
  }
  return text;
}

std::string poseText(const mrpt::poses::CPose3D& pose) {
  return "x " + fixed(pose.x(), 2) + " y " + fixed(pose.y(), 2) + " z " + fixed(pose.z(), 2) + " m, yaw " +
         fixed(degrees(pose.yaw()), 0) + " pitch " + fixed(degrees(pose.pitch()), 0) + " roll " +
         fixed(degrees(pose.roll()), 0) + " deg";
}

std::string scanLines(const LogFacts& facts) {
  std::string text;
  for (const auto& [label, scans] : facts.scans) {
    text += quoted(label) + ": " + std::to_string(scans.beams) + " beams over " + fixed(degrees(scans.aperture), 0) +
            " deg, " + percent(scans.valid_share) + " of them valid; median range " + fixed(scans.median_range, 1) +
            " m, largest " + fixed(scans.longest, 1) + " m (limit of the sensor " + fixed(scans.max_range, 1) +
            " m)\n  pose on the base: " + poseText(scans.base_from_sensor) +
            (scans.isAtOrigin() ? "; it was probably never set" : "") +
            (scans.sweep
                 ? "; sweep by its turns " + fixed(scans.sweep->sweep, 4) + " +- " + fixed(scans.sweep->sigma, 4) + " s"
                 : "") +
            "\n";
  }
  return text;
}

std::string millimetres(double metres) {
  constexpr double kLeast = 0.001;  // [m] smallest noise that scan matching can measure
  return metres < kLeast ? "less than 1 mm" : fixed(1000 * metres, 0) + " mm";
}

std::string noiseText(const MotionFacts& motion) {
  std::vector<std::string> parts;
  if (motion.position_noise_per_root_m)
    parts.push_back(millimetres(*motion.position_noise_per_root_m) + " after 1 m travelled");
  if (motion.yaw_noise_per_root_m)
    parts.push_back(fixed(degrees(*motion.yaw_noise_per_root_m), 2) + " deg after 1 m travelled");
  if (motion.yaw_noise_per_root_turn) {
    parts.push_back(fixed(degrees(*motion.yaw_noise_per_root_turn), 2) + " deg after a turn of 1 rad");
  }
  return parts.empty() ? "" : "; noise of the odometry: " + joined(parts, ", ");
}

std::string odometryLines(const LogFacts& facts) {
  std::string text;
  for (const auto& [label, odometry] : facts.odometry) {
    text += quoted(label) + ": " + fixed(odometry.travel, 1) + " m travelled and " +
            fixed(degrees(odometry.turn) / 360, 1) + " full turns, by odometry\n";
  }
  for (const auto& motion : facts.motions) {
    if (motion.odometry.empty()) continue;
    text += "  " + quoted(motion.odometry) + " compared with " + quoted(motion.laser) + ": " +
            std::to_string(motion.matched) + " of " + std::to_string(motion.tried) + " pairs of scans were matched, " +
            std::to_string(motion.moved) + " of these show motion" + noiseText(motion) + "\n";
  }
  return text;
}

// The names of several INIs, which are joined by a plus sign, as options of the command line.
std::string asOptions(std::string inis) {
  for (auto at = inis.find(" + "); at != std::string::npos; at = inis.find(" + ")) inis.replace(at, 3, " -i ");
  return inis;
}

std::string valueText(const std::string& name, const std::optional<Measured>& value, double unit, int decimals,
                      const std::string& unit_name) {
  if (!value) return "";
  return ", " + name + " " + fixed(value->value / unit, decimals) + " +- " + fixed(value->sigma / unit, decimals) +
         unit_name;
}

std::string cameraLines(const LogFacts& facts) {
  std::string text;
  for (const auto& camera : facts.cameras) {
    text += quoted(camera.camera) + ": " + std::to_string(camera.columns) + " x " + std::to_string(camera.rows) +
            " px, median depth " + fixed(camera.median_depth, 2) +
            " m; pose on the base: " + poseText(camera.declared) + "\n  " + counted(camera.planes, "plane") + " in " +
            counted(camera.images, "image");
    if (camera.height) {
      text += "; the floor in " + std::to_string(camera.floor_images) + " of them, " + fixed(camera.height->value, 2) +
              " m below the camera and tilted by " + fixed(degrees(camera.tilt), 1) + " deg";
    }
    if (!camera.laser.empty()) {
      text += "; " + std::to_string(camera.matched) + " of " + counted(camera.walls, "upright plane") +
              " on walls of " + quoted(camera.laser) +
              valueText("yaw off by", camera.yaw, base::option_text::kRadiansPerDegree, 1, " deg") +
              valueText("scale of the depths", camera.scale, 1, 3, "") +
              valueText("of the focal length", camera.focal, 1, 3, "") +
              valueText("clock late by", camera.clock, 1, 3, " s");
    }
    text += "\n";
  }
  return text;
}

std::string findingLines(const std::vector<Finding>& findings) {
  if (findings.empty()) return "\nNothing is wrong with the observations.\n";
  std::string text = "\n";
  for (const auto& finding : findings) {
    const char* weight = finding.weight == Weight::problem   ? "PROBLEM  "
                         : finding.weight == Weight::warning ? "warning  "
                                                             : "note     ";
    text += weight + finding.text + "\n";
  }
  return text;
}

std::string iniLines(const std::vector<FittingIni>& inis) {
  std::string text;
  for (const auto& ini : inis) {
    char line[200];
    std::snprintf(line, sizeof line, "  %-20s %s\n", ini.file.c_str(), ini.what.c_str());
    text += line;
  }
  return text;
}

}  // namespace

std::string checkText(const std::string& title, const source::SourceReport& report, const LogFacts& facts,
                      const std::vector<Finding>& findings, const std::vector<FittingIni>& inis, const std::string& ini,
                      const std::vector<Setting>& settings) {
  base::Stamp first, last;
  for (const auto& [sensor, stamps] : facts.sensors) {
    if (!base::isValid(stamps.first)) continue;
    first = base::isValid(first) ? std::min(first, stamps.first) : stamps.first;
    last = std::max(last, stamps.last);
  }
  std::string text = title + ": " + toString(report.ending) + ", " +
                     counted(static_cast<std::size_t>(report.observations()), "observation") + " in " +
                     fixed(base::secondsBetween(first, last), 1) + " s\n";
  if (!report.message.empty()) text += report.message + "\n";
  text += sensorTable(facts) + scanLines(facts) + odometryLines(facts) + cameraLines(facts);
  for (const auto& note : report.notes) text += "  " + note + "\n";
  text += findingLines(findings);
  if (inis.empty()) return text;
  text += "\nINIs that fit this log, first the one that uses most of its sensors:\n" + iniLines(inis);
  if (settings.empty() && inis.front().file == ini && inis.front().needs_settings) return text;
  if (settings.empty()) {
    const bool is_broken = !findings.empty() && findings.front().weight == Weight::problem;
    return text +
           (is_broken ? "No setting of " + ini + " is proposed: what solves the problems above is to be set by hand"
                      : "No setting of " + ini + " needs to be changed for this log" +
                            (findings.empty() ? "" : ", in spite of the findings above")) +
           ".\n";
  }
  return text + "\nSettings that improve " + ini +
         " for this log. With -o FOLDER they are written to a file; use them as -i " + asOptions(ini) +
         " -i FOLDER/check.ini:\n\n" + toIni(settings);
}

}  // namespace omnimapper::check
