#include <omnimapper/base/AtLoad.h>
#include <omnimapper/mapper/PluginRegistry.h>
#include <omnimapper/obs/registerClasses.h>
#include <omnimapper/plugins/ArucoMarkersPlugin.h>
#include <omnimapper/plugins/CloudPlanesPlugin.h>
#include <omnimapper/plugins/EdgesPlugin.h>
#include <omnimapper/plugins/GeoJsonOutput.h>
#include <omnimapper/plugins/GivenMotionPlugin.h>
#include <omnimapper/plugins/GpsPlugin.h>
#include <omnimapper/plugins/GraphOutput.h>
#include <omnimapper/plugins/GridOutput.h>
#include <omnimapper/plugins/LaserLinesPlugin.h>
#include <omnimapper/plugins/LaserPointsPlugin.h>
#include <omnimapper/plugins/LiveWindow.h>
#include <omnimapper/plugins/LocalizationOutput.h>
#include <omnimapper/plugins/LoopClosurePlugin.h>
#include <omnimapper/plugins/MapOutput.h>
#include <omnimapper/plugins/MoveableThingsPlugin.h>
#include <omnimapper/plugins/NoMotionPlugin.h>
#include <omnimapper/plugins/ObjectsPlugin.h>
#include <omnimapper/plugins/OdometryPlugin.h>
#include <omnimapper/plugins/PlaneLandmarksPlugin.h>
#include <omnimapper/plugins/PlanesPlugin.h>
#include <omnimapper/plugins/PointLandmarksPlugin.h>
#include <omnimapper/plugins/PointsOutput.h>
#include <omnimapper/plugins/RelationsPlugin.h>
#include <omnimapper/plugins/ReportOutput.h>
#include <omnimapper/plugins/RoadPlugin.h>
#include <omnimapper/plugins/RobotPosePlugin.h>
#include <omnimapper/plugins/ScanOdometryPlugin.h>
#include <omnimapper/plugins/SceneOutput.h>
#include <omnimapper/plugins/SummaryOutput.h>
#include <omnimapper/plugins/TrajectoryOutput.h>
#include <omnimapper/plugins/registerPlugins.h>

namespace omnimapper::plugins {

void registerPlugins() {
  obs::registerClasses();
  mapper::registerFactoryBases();
  using mrpt::rtti::registerClass;
  registerClass(CLASS_ID(OdometryPluginFactory));
  registerClass(CLASS_ID(GivenMotionPluginFactory));
  registerClass(CLASS_ID(NoMotionPluginFactory));
  registerClass(CLASS_ID(ScanOdometryPluginFactory));
  registerClass(CLASS_ID(ArucoMarkersPluginFactory));
  registerClass(CLASS_ID(CloudPlanesPluginFactory));
  registerClass(CLASS_ID(EdgesPluginFactory));
  registerClass(CLASS_ID(LaserLinesPluginFactory));
  registerClass(CLASS_ID(LaserPointsPluginFactory));
  registerClass(CLASS_ID(ObjectsPluginFactory));
  registerClass(CLASS_ID(PlanesPluginFactory));
  registerClass(CLASS_ID(RoadPluginFactory));
  registerClass(CLASS_ID(LoopClosurePluginFactory));
  registerClass(CLASS_ID(RobotPosePluginFactory));
  registerClass(CLASS_ID(GpsPluginFactory));
  registerClass(CLASS_ID(PlaneLandmarksPluginFactory));
  registerClass(CLASS_ID(RelationsPluginFactory));
  registerClass(CLASS_ID(PointLandmarksPluginFactory));
  registerClass(CLASS_ID(GeoJsonOutputFactory));
  registerClass(CLASS_ID(MoveableThingsPluginFactory));
  registerClass(CLASS_ID(GraphOutputFactory));
  registerClass(CLASS_ID(GridOutputFactory));
  registerClass(CLASS_ID(LiveWindowFactory));
  registerClass(CLASS_ID(LocalizationOutputFactory));
  registerClass(CLASS_ID(MapOutputFactory));
  registerClass(CLASS_ID(PointsOutputFactory));
  registerClass(CLASS_ID(ReportOutputFactory));
  registerClass(CLASS_ID(SceneOutputFactory));
  registerClass(CLASS_ID(SummaryOutputFactory));
  registerClass(CLASS_ID(TrajectoryOutputFactory));
}

// The build links this file last: the ids of the classes are made before.
const base::AtLoad kRegister(registerPlugins);

}  // namespace omnimapper::plugins
