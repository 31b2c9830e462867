#include <omnimapper/sim/Laser2d.h>
#include <omnimapper/sim/Sensor.h>

#include "ColourCamera.h"
#include "RgbdCamera.h"

namespace omnimapper::sim {

const std::vector<SensorClass>& sensorClasses() {
  static const std::vector<SensorClass> classes{
      sensorClass<ColourCamera, ColourCameraOptions>("ColourCamera",
                                                     "A colour camera on a pan-tilt: CObservationImage."),
      sensorClass<RgbdCamera, RgbdOptions>("RgbdCamera", "A camera of depth and colour: CObservation3DRangeScan."),
      laser2dClass(),
  };
  return classes;
}

}  // namespace omnimapper::sim
