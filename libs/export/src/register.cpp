#include <omnimapper/base/AtLoad.h>
#include <omnimapper/export/registerOutputs.h>

#include "grid/GridOutput.h"
#include "map/MapOutput.h"
#include "plan/GeoJsonOutput.h"
#include "plan/SurfacesOutput.h"
#include "report/ReportOutput.h"
#include "run/GraphOutput.h"
#include "run/LocalizationOutput.h"
#include "run/SummaryOutput.h"
#include "run/TrajectoryOutput.h"
#include "scene/LiveWindow.h"
#include "scene/PointsOutput.h"
#include "scene/SceneOutput.h"

namespace omnimapper::exports {

void registerOutputs() {
  using mrpt::rtti::registerClass;
  mapper::registerFactoryBases();
  registerClass(CLASS_ID(GeoJsonOutputFactory));
  registerClass(CLASS_ID(GraphOutputFactory));
  registerClass(CLASS_ID(GridOutputFactory));
  registerClass(CLASS_ID(LiveWindowFactory));
  registerClass(CLASS_ID(LocalizationOutputFactory));
  registerClass(CLASS_ID(MapOutputFactory));
  registerClass(CLASS_ID(PointsOutputFactory));
  registerClass(CLASS_ID(ReportOutputFactory));
  registerClass(CLASS_ID(SceneOutputFactory));
  registerClass(CLASS_ID(SummaryOutputFactory));
  registerClass(CLASS_ID(SurfacesOutputFactory));
  registerClass(CLASS_ID(TrajectoryOutputFactory));
}

// This file is linked last, so that the class ids exist before it runs.
const base::AtLoad kRegister(registerOutputs);

}  // namespace omnimapper::exports
