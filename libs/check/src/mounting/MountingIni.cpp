#include "MountingIni.h"

#include <omnimapper/base/Names.h>
#include <omnimapper/base/Numbers.h>
#include <omnimapper/mapper/EngineOptions.h>

#include <algorithm>
#include <array>
#include <sstream>

#include "../Format.h"

namespace omnimapper::check {

namespace {

using State = Quantity::State;

std::vector<std::string> sectionsOf(const base::Config& config) {
  return config.section("mapper").read<mapper::EngineOptions>().sensors;
}

// The section of [mapper] sensors that is for this label; empty if there is none.
std::string sectionInIni(const base::Config& config, const std::string& label) {
  for (const auto& section : sectionsOf(config)) {
    std::string text;
    if (config.section(section).find("label", text) && text == label) return section;
  }
  return "";
}

bool hasPoseFile(const base::Config& config, const std::string& label) {
  std::string text;
  const auto section = sectionInIni(config, label);
  return !section.empty() && config.section(section).find("pose_file", text) && !text.empty();
}

// The INI has a [calibration] of another camera, or of all.
bool isTaken(const base::Config& config, const std::string& label) {
  if (!config.has("calibration")) return false;
  std::string text;
  config.section("calibration").find("label", text);
  return text != label;
}

// What a comment says of a value: how well it is known, and by what.
std::string commentOf(const SensorMounting& mounting, const std::string& sensor, const std::string& name) {
  const auto found = std::find_if(mounting.quantities.begin(), mounting.quantities.end(), [&](const Quantity& one) {
    return one.sensor == sensor && one.name == name && one.state != State::not_determined;
  });
  if (found == mounting.quantities.end() || found->state == State::two_causes) return "as declared";
  std::string comment = found->reason;
  if (found->state == State::as_declared) {
    comment = "as declared; measured " + found->measuredText();
  } else if (found->words.empty() && found->measured.sigma > 0) {
    comment = found->sigmaText() + ", " + found->reason;
  }
  // A label from a log must not change how the line is read.
  comment = base::printable(comment);
  std::replace(comment.begin(), comment.end(), '$', '_');
  return comment;
}

std::vector<MountingLine> poseLines(const SensorMounting& mounting, const std::string& section,
                                    const std::string& label, const mrpt::poses::CPose3D& pose) {
  const auto angle = [](double radians) {
    constexpr double kHalfTurn = 179.995;  // -180 and 180 are the same angle
    const double value = degrees(radians);
    return base::fixed(value < -kHalfTurn ? value + 360 : value, 2);
  };
  const std::vector<std::array<std::string, 3>> keys{
      {"pose_x_m", base::fixed(pose.x(), 3), "x"},      {"pose_y_m", base::fixed(pose.y(), 3), "y"},
      {"pose_z_m", base::fixed(pose.z(), 3), "height"}, {"pose_yaw_deg", angle(pose.yaw()), "yaw"},
      {"pose_pitch_deg", angle(pose.pitch()), "pitch"}, {"pose_roll_deg", angle(pose.roll()), "roll"},
  };
  std::vector<MountingLine> lines;
  for (const auto& [key, value, name] : keys) lines.push_back({section, key, value, commentOf(mounting, label, name)});
  return lines;
}

std::vector<MountingLine> sensorLines(const SensorMounting& mounting, const base::Config& config,
                                      const std::string& section, const std::string& label, const SensorKeys& keys) {
  std::vector<MountingLine> lines{{section, "label", label, ""}};
  if (keys.pose && !hasPoseFile(config, label)) {
    for (auto& line : poseLines(mounting, section, label, *keys.pose)) lines.push_back(std::move(line));
  }
  if (keys.aperture)
    lines.push_back(
        {section, "aperture_deg", base::fixed(degrees(*keys.aperture), 1), commentOf(mounting, label, "aperture")});
  if (keys.clock_offset)
    lines.push_back(
        {section, "clock_offset_s", base::fixed(*keys.clock_offset, 4), commentOf(mounting, label, "clock")});
  return lines;
}

std::vector<MountingLine> calibrationLines(const SensorMounting& mounting, const std::string& label,
                                           const CalibrationKeys& keys) {
  const std::string section = "calibration";
  std::vector<MountingLine> lines{{section, "label", label, ""}};
  const auto flag = [&](const char* key, const std::optional<bool>& value) {
    if (value) lines.push_back({section, key, *value ? "true" : "false", commentOf(mounting, label, "images")});
  };
  flag("mirrored", keys.mirrored);
  flag("depth_is_range", keys.depth_is_range);
  if (keys.depth_scale)
    lines.push_back(
        {section, "depth_scale", base::brief(*keys.depth_scale, 5), commentOf(mounting, label, "depth scale")});
  if (keys.fx) {
    lines.push_back({section, "depth_fx_px", base::fixed(*keys.fx, 1), commentOf(mounting, label, "focal length")});
    lines.push_back({section, "depth_fy_px", base::fixed(*keys.fy, 1), "by the same factor"});
  }
  return lines;
}

bool isEmpty(const SensorKeys& keys) {
  return !keys.pose && !keys.aperture && !keys.clock_offset;
}

// Comment lines of at most some hundred characters.
std::string wrapped(const std::string& text) {
  constexpr std::size_t kMost = 100;
  std::istringstream words(base::printable(text));
  std::string all, line = ";", word;
  while (words >> word) {
    if (line.size() + word.size() > kMost) {
      all += line + "\n";
      line = ";";
    }
    line += " " + word;
  }
  return all + line + "\n";
}

std::string asText(const MountingLine& line) {
  return (line.is_active ? "" : "; ") + line.key + " = " + line.value +
         (line.comment.empty() ? "" : "  ; " + line.comment) + "\n";
}

}  // namespace

std::vector<MountingLine> mountingLines(const SensorMounting& mounting, const base::Config& config,
                                        bool has_laser_odometry) {
  std::vector<MountingLine> all;
  auto sections = sectionsOf(config);
  const std::size_t before = sections.size();
  for (const auto& [label, keys] : mounting.sensors) {
    if (isEmpty(keys) || !base::fitsIni(label)) continue;
    auto section = sectionInIni(config, label);
    if (section.empty()) {
      section = sectionOf(label);
      while (std::find(sections.begin(), sections.end(), section) != sections.end()) section += "_";
      sections.push_back(section);
    }
    for (auto& line : sensorLines(mounting, config, section, label, keys)) all.push_back(std::move(line));
  }
  if (sections.size() > before) all.insert(all.begin(), {"mapper", "sensors", joined(sections, ", "), ""});
  for (const auto& [label, keys] : mounting.cameras) {
    if (!base::fitsIni(label) || isTaken(config, label)) continue;
    for (auto& line : calibrationLines(mounting, label, keys)) all.push_back(std::move(line));
    break;  // the section holds one camera
  }
  if (mounting.sweep) {
    const auto laser = std::find_if(mounting.quantities.begin(), mounting.quantities.end(),
                                    [](const Quantity& one) { return one.name == "sweep"; });
    all.push_back({"scan_odometry", "sweep_s", base::fixed(*mounting.sweep, 4),
                   commentOf(mounting, laser->sensor, "sweep"), has_laser_odometry});
  }
  return all;
}

std::vector<std::string> leftOutOfIni(const SensorMounting& mounting, const base::Config& config) {
  std::vector<std::string> all;
  for (const auto& [label, keys] : mounting.sensors) {
    if (!base::fitsIni(label))
      all.push_back(check::quoted(label) + ": no INI can name this label; record it with another one");
    if (keys.pose && hasPoseFile(config, label))
      all.push_back(check::quoted(label) +
                    ": the INI gives its poses over time in pose_file, which mounting.ini leaves alone");
  }
  std::size_t written = 0;
  for (const auto& [label, keys] : mounting.cameras) {
    if (!isTaken(config, label) && written++ == 0) continue;
    all.push_back(check::quoted(label) +
                  ": its images need a [calibration], which is in use for another camera or for all; set it by hand");
  }
  return all;
}

std::string mountingIni(const std::vector<MountingLine>& lines, const SensorMounting& mounting,
                        const std::string& title) {
  std::string text = base::kWrittenFromALog + " by omnimapper-calibrate mounting: " + base::printable(title) +
                     "\n; After +- stands the standard deviation of the value.\n";
  std::string section;
  for (const auto& line : lines) {
    const bool has_active = std::any_of(lines.begin(), lines.end(), [&](const MountingLine& one) {
      return one.section == line.section && one.is_active;
    });
    if (line.section != section) text += std::string(has_active ? "\n[" : "\n; [") + line.section + "]\n";
    section = line.section;
    text += asText(line);
  }
  if (lines.empty()) text += "; Nothing is declared wrong as far as the log shows it.\n";
  text += "\n";
  for (const auto& one : mounting.quantities) {
    if (one.state == State::as_declared && one.words.empty())
      text += wrapped(check::quoted(one.sensor) + ": " + one.name + " " + one.declaredText() +
                      " as declared; measured " + one.measuredText());
  }
  for (const auto& causes : mounting.two_causes) {
    text += "\n" + wrapped("TWO CAUSES. " + causes.text);
    if (!base::fitsIni(causes.sensor)) continue;
    const auto name = sectionOf(causes.sensor);
    text += wrapped("If " + causes.if_so + ", use the lines below without their semicolons, and name the section in " +
                    "[mapper] sensors:") +
            "; [" + name + "]\n; label = " + causes.sensor + "\n";
    for (auto line : poseLines(mounting, name, causes.sensor, *causes.keys.pose)) {
      line.is_active = false;
      line.comment.clear();
      text += asText(line);
    }
  }
  return text;
}

}  // namespace omnimapper::check
