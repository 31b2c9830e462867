#include <mrpt/opengl/stock_objects.h>
#include <omnimapper/obs/CDerivedObservation.h>
#include <omnimapper/obs/SceneDrawing.h>

#include "Fields.h"
#include "TextRow.h"

namespace omnimapper::obs {

CDerivedObservation::CDerivedObservation() {
  timestamp = base::Stamp();
}

void CDerivedObservation::writeHead(mrpt::serialization::CArchive& out) const {
  out << timestamp;
  writeText(out, sensorLabel);
  writeText(out, source_label);
  writePose(out, sensorPose);
}

void CDerivedObservation::readHead(mrpt::serialization::CArchive& in) {
  in >> timestamp;
  sensorLabel = readText(in);
  source_label = readText(in);
  sensorPose = readPose(in);
}

void CDerivedObservation::getDescriptionAsText(std::ostream& out) const {
  CObservation::getDescriptionAsText(out);
  out << "Derived from the observation labelled: " << inAscii(source_label) << "\n"
      << "Pose of the sensor on the base (x y z [m], yaw pitch roll [deg]): " << sensorPose.asString() << "\n";
  describe(out);
}

void CDerivedObservation::getVisualizationInto(mrpt::opengl::CSetOfObjects& scene) const {
  auto in_sensor = mrpt::opengl::CSetOfObjects::Create();
  in_sensor->setPose(sensorPose);
  in_sensor->insert(mrpt::opengl::stock_objects::CornerXYZ(0.1F));
  draw(*in_sensor);
  scene.insert(in_sensor);
}

}  // namespace omnimapper::obs
