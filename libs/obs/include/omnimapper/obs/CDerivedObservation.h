#pragma once

#include <mrpt/obs/CObservation.h>
#include <mrpt/opengl/Visualizable.h>
#include <mrpt/poses/CPose3D.h>
#include <mrpt/serialization/CArchive.h>
#include <omnimapper/base/Stamp.h>

namespace omnimapper::obs {

/// What all observations have in common that perception makes of a raw one: its stamp, its sensor's pose, and geometry
/// in that sensor's frame. No class of its own for MRPT: the observations themselves are.
///
/// As text (rawlog-edit --export-txt) each is one row: a count, then that many groups of fields. The header names the
/// fields of a group once, between { and }; groups may hold a count with groups in turn. Numbers are in full; a text
/// has its blanks, control characters and % written as %20 and the like, and is - where it is empty. What is optional
/// and absent is nan, for indices and colours -1.
class CDerivedObservation : public mrpt::obs::CObservation, public mrpt::opengl::Visualizable {
 public:
  /// Pose of the sensor on the base.
  mrpt::poses::CPose3D sensorPose;
  /// Label of the raw observation that this one was made of; both have one stamp.
  std::string source_label;

  void getSensorPose(mrpt::poses::CPose3D& sensor_pose) const final { sensor_pose = sensorPose; }
  void setSensorPose(const mrpt::poses::CPose3D& sensor_pose) final { sensorPose = sensor_pose; }
  void getDescriptionAsText(std::ostream& out) const final;
  bool exportTxtSupported() const final { return true; }

  /// In the frame of the base, the sensor as a small corner.
  void getVisualizationInto(mrpt::opengl::CSetOfObjects& scene) const final;

 protected:
  /// Without a stamp.
  CDerivedObservation();

  void writeHead(mrpt::serialization::CArchive& out) const;
  void readHead(mrpt::serialization::CArchive& in);

  /// What was found, a line for each.
  virtual void describe(std::ostream& out) const = 0;
  /// In the frame of the sensor. Nothing may be taken for granted of the numbers: they may come from a damaged file.
  virtual void draw(mrpt::opengl::CSetOfObjects& scene_in_sensor) const = 0;
};

}  // namespace omnimapper::obs
