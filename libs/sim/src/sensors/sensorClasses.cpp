#include <omnimapper/sim/Gps.h>
#include <omnimapper/sim/Imu.h>
#include <omnimapper/sim/Laser2d.h>
#include <omnimapper/sim/Laser3d.h>
#include <omnimapper/sim/Odometry.h>
#include <omnimapper/sim/RangeBearing.h>
#include <omnimapper/sim/Sensor.h>

#include "ColourCamera.h"
#include "RgbdCamera.h"
#include "SkeletonTracker.h"

namespace omnimapper::sim {

const std::vector<SensorClass>& sensorClasses() {
  static const std::vector<SensorClass> classes{
      sensorClass<ColourCamera, ColourCameraOptions>("ColourCamera",
                                                     "A colour camera on a pan-tilt: CObservationImage."),
      sensorClass<RgbdCamera, RgbdOptions>("RgbdCamera", "A camera of depth and colour: CObservation3DRangeScan."),
      laser2dClass(),
      sensorClass<Laser3d, Laser3dOptions>("Laser3d", "A turning laser of many rings: CObservationPointCloud."),
      sensorClass<Odometry, OdometryOptions>("Odometry", "Wheel odometry with bias and slip: CObservationOdometry."),
      sensorClass<Imu, ImuOptions>("Imu", "A gyroscope and accelerometer: CObservationIMU."),
      sensorClass<Gps, GpsOptions>("Gps", "A satellite receiver: CObservationGPS with GGA."),
      sensorClass<RangeBearing, RangeBearingOptions>("RangeBearing",
                                                     "Ranges and bearings of landmarks: CObservationBearingRange."),
      sensorClass<SkeletonTracker, SkeletonTrackerOptions>(
          "SkeletonTracker", "Software that finds people's joints in depth images: CObservationSkeleton."),
  };
  return classes;
}

}  // namespace omnimapper::sim
