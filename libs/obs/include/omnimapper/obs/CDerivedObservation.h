#pragma once

#include <mrpt/obs/CObservation.h>
#include <mrpt/opengl/Visualizable.h>
#include <mrpt/poses/CPose3D.h>
#include <mrpt/serialization/CArchive.h>
#include <omnimapper/base/Stamp.h>

namespace omnimapper::obs {

/// Base class of all observations that perception derives from a raw observation. They have the stamp of the raw
/// observation and the pose of its sensor, and their geometry is in the frame of that sensor. Only its derived classes
/// are registered in MRPT's run-time class system.
///
/// As text (rawlog-edit --export-txt) each observation is one row: a count, then that many groups of fields. The header
/// names the fields of a group once, between { and }; a group may contain a count with further groups. Numbers are
/// written with full precision. In a text, blanks, control characters and % are written as %20 and the like; an empty
/// text is written as -. An optional value that is absent is nan; for indices and colours it is -1.
class CDerivedObservation : public mrpt::obs::CObservation, public mrpt::opengl::Visualizable {
 public:
  /// Pose of the sensor on the base.
  mrpt::poses::CPose3D sensorPose;
  /// Label of the raw observation that this one was derived from; both have the same stamp.
  std::string source_label;

  void getSensorPose(mrpt::poses::CPose3D& sensor_pose) const final { sensor_pose = sensorPose; }
  void setSensorPose(const mrpt::poses::CPose3D& sensor_pose) final { sensorPose = sensor_pose; }
  void getDescriptionAsText(std::ostream& out) const final;
  bool exportTxtSupported() const final { return true; }

  /// Draws the observation in the frame of the base, with small axes at the sensor's pose.
  void getVisualizationInto(mrpt::opengl::CSetOfObjects& scene) const final;

 protected:
  /// A new observation has no stamp.
  CDerivedObservation();

  void writeHead(mrpt::serialization::CArchive& out) const;
  void readHead(mrpt::serialization::CArchive& in);

  /// Describes what was found, one line for each item.
  virtual void describe(std::ostream& out) const = 0;
  /// Draws in the frame of the sensor. The numbers may have any value, because they may come from a damaged file.
  virtual void draw(mrpt::opengl::CSetOfObjects& scene_in_sensor) const = 0;
};

}  // namespace omnimapper::obs
