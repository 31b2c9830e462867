#pragma once

#include <mrpt/obs/CObservation.h>
#include <mrpt/opengl/Visualizable.h>
#include <omnimapper/base/Stamp.h>

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace omnimapper::obs {

/// What is asked. The numbers are stored in files.
enum class CommandKind : std::uint8_t {
  label = 0,       ///< name what a person points at, or the place; `text` is the label
  go_to = 1,       ///< go to what has the name `text`
  follow = 2,      ///< follow the person who asks
  stop = 3,        ///< end whatever is being done
  move = 4,        ///< move the base by `motion`
  standby = 5,     ///< wait for further commands
  edit = 6,        ///< change something in the map; `text` says what, to the plugin that understands it
  plugin_on = 7,   ///< make the plugin of the INI section `text`
  plugin_off = 8,  ///< remove the plugin of the INI section `text`
};

/// What a label is for.
enum class CommandSubject : std::uint8_t {
  any = 0,     ///< it is not known
  map = 1,     ///< a structure of the map, such as a table top or a wall ("label map" of the thesis, 6.2.8)
  object = 2,  ///< an object ("label object")
  place = 3,   ///< the place where the robot stands
};

/// The names of these values in text: "go_to", "object". An unknown value has the name "unknown".
std::string nameOf(CommandKind kind);
std::string nameOf(CommandSubject subject);
/// None if no value has this name.
std::optional<CommandKind> commandKind(std::string_view name);
std::optional<CommandSubject> commandSubject(std::string_view name);

/// What a person or a program asks of the robot (thesis 6.2.3, LabelRequest; 6.2.5). `timestamp` is when it was asked.
/// A command is an observation, so that it is recorded and a replay meets it at the same time; a replay moves no robot.
/// It has no sensor pose.
///
/// As text (rawlog-edit --export-txt) a row has kind, subject, text, origin, expiry_s and the motion. In a text,
/// blanks, control characters and % are written as %20 and the like; an empty text is written as -.
class CObservationCommand : public mrpt::obs::CObservation, public mrpt::opengl::Visualizable {
  DEFINE_SERIALIZABLE(CObservationCommand, omnimapper::obs)

 public:
  /// Without a stamp.
  CObservationCommand();

  CommandKind kind = CommandKind::standby;
  CommandSubject subject = CommandSubject::any;
  std::string text;    ///< UTF-8, as it was given: it may be long and may have control characters
  std::string origin;  ///< who asks: a person's name, "page", a program; may be empty
  double expiry = 0;   ///< [s] after the stamp, until which it can be answered; 0: the answering program decides
  /// Of `move`, in the base: forward [m], to the left [m], then a turn to the left [rad].
  Eigen::Vector3d motion = Eigen::Vector3d::Zero();

  /// Identity.
  void getSensorPose(mrpt::poses::CPose3D& sensor_pose) const override;
  /// Throws Error(internal) for any pose but identity.
  void setSensorPose(const mrpt::poses::CPose3D& sensor_pose) override;
  void getDescriptionAsText(std::ostream& out) const override;

  bool exportTxtSupported() const override { return true; }
  std::string exportTxtHeader() const override;
  std::string exportTxtDataRow() const override;

  /// Draws nothing: a command is at no place.
  void getVisualizationInto(mrpt::opengl::CSetOfObjects& scene) const override;
};

}  // namespace omnimapper::obs
