#include <mrpt/poses/CPose3D.h>
#include <mrpt/serialization/CArchive.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/base/Names.h>
#include <omnimapper/obs/CObservationCommand.h>

#include <algorithm>
#include <array>
#include <cstddef>

#include "Fields.h"
#include "TextRow.h"

IMPLEMENTS_SERIALIZABLE(CObservationCommand, mrpt::obs::CObservation, omnimapper::obs)

namespace omnimapper::obs {

namespace {

// By the numbers of the values.
constexpr std::array<const char*, 9> kKinds{"label",   "go_to", "follow",    "stop",      "move",
                                            "standby", "edit",  "plugin_on", "plugin_off"};
constexpr std::array<const char*, 4> kSubjects{"any", "map", "object", "place"};

template <class Value, std::size_t count>
std::string nameIn(const std::array<const char*, count>& names, Value value) {
  const auto number = static_cast<std::size_t>(value);
  return number < count ? names[number] : "unknown";
}

template <class Value, std::size_t count>
std::optional<Value> valueIn(const std::array<const char*, count>& names, std::string_view name) {
  const auto place = std::find(names.begin(), names.end(), name);
  if (place == names.end()) return std::nullopt;
  return static_cast<Value>(place - names.begin());
}

template <class Value, std::size_t count>
Value readValue(Archive& in, const std::array<const char*, count>& /*names*/, const char* what) {
  const auto number = readNumber<std::uint8_t>(in);
  if (number < count) return static_cast<Value>(number);
  throw base::Error(base::ExitCode::damaged_input,
                    "CObservationCommand: there is no " + std::string(what) + " " + std::to_string(number) + ".");
}

}  // namespace

std::string nameOf(CommandKind kind) {
  return nameIn(kKinds, kind);
}

std::string nameOf(CommandSubject subject) {
  return nameIn(kSubjects, subject);
}

std::optional<CommandKind> commandKind(std::string_view name) {
  return valueIn<CommandKind>(kKinds, name);
}

std::optional<CommandSubject> commandSubject(std::string_view name) {
  return valueIn<CommandSubject>(kSubjects, name);
}

CObservationCommand::CObservationCommand() {
  timestamp = base::Stamp();
}

uint8_t CObservationCommand::serializeGetVersion() const {
  return 0;
}

void CObservationCommand::serializeTo(mrpt::serialization::CArchive& out) const {
  out << timestamp;
  writeText(out, sensorLabel);
  out << static_cast<std::uint8_t>(kind) << static_cast<std::uint8_t>(subject);
  writeText(out, text);
  writeText(out, origin);
  out << expiry;
  writeMatrix(out, motion);
}

void CObservationCommand::serializeFrom(mrpt::serialization::CArchive& in, uint8_t version) {
  if (version != 0) refuseVersion("CObservationCommand", version);
  in >> timestamp;
  sensorLabel = readText(in);
  kind = readValue<CommandKind>(in, kKinds, "kind of commands");
  subject = readValue<CommandSubject>(in, kSubjects, "subject of labels");
  text = readText(in);
  origin = readText(in);
  expiry = readNumber<double>(in);
  motion = readMatrix<Eigen::Vector3d>(in);
}

void CObservationCommand::getSensorPose(mrpt::poses::CPose3D& sensor_pose) const {
  sensor_pose = mrpt::poses::CPose3D();
}

void CObservationCommand::setSensorPose(const mrpt::poses::CPose3D& sensor_pose) {
  if (sensor_pose != mrpt::poses::CPose3D())
    throw base::Error(base::ExitCode::internal, "CObservationCommand has no sensor pose: a command is at no place.");
}

void CObservationCommand::getDescriptionAsText(std::ostream& out) const {
  CObservation::getDescriptionAsText(out);
  out << "Command: " << nameOf(kind);
  if (!text.empty()) out << " \"" << base::printable(inAscii(text)) << "\"";
  if (kind == CommandKind::label) out << ", for " << nameOf(subject);
  if (kind == CommandKind::move)
    out << " by " << shortly(motion.x()) << " m forward, " << shortly(motion.y()) << " m to the left, "
        << shortly(motion.z()) << " rad to the left";
  out << "\n";
  if (!origin.empty()) out << "Asked by \"" << base::printable(inAscii(origin)) << "\"\n";
  if (expiry > 0) out << "Valid for " << shortly(expiry) << " s\n";
}

std::string CObservationCommand::exportTxtHeader() const {
  return "kind subject text origin expiry_s forward_m left_m turn_rad";
}

std::string CObservationCommand::exportTxtDataRow() const {
  TextRow row;
  row.text(nameOf(kind)).text(nameOf(subject)).text(text).text(origin).number(expiry).vector(motion);
  return row.str();
}

void CObservationCommand::getVisualizationInto(mrpt::opengl::CSetOfObjects& /*scene*/) const {}

}  // namespace omnimapper::obs
