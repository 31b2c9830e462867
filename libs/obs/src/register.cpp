#include <omnimapper/base/AtLoad.h>
#include <omnimapper/obs/CObservationCommand.h>
#include <omnimapper/obs/CObservationDoorSigns.h>
#include <omnimapper/obs/CObservationLaserLines.h>
#include <omnimapper/obs/CObservationObjects.h>
#include <omnimapper/obs/CObservationPlanes.h>
#include <omnimapper/obs/CObservationRelativeMotion.h>
#include <omnimapper/obs/registerClasses.h>

namespace omnimapper::obs {

const std::vector<const mrpt::rtti::TRuntimeClassId*>& allClasses() {
  static const std::vector<const mrpt::rtti::TRuntimeClassId*> classes = {
      CLASS_ID(CObservationRelativeMotion), CLASS_ID(CObservationPlanes),    CLASS_ID(CObservationLaserLines),
      CLASS_ID(CObservationObjects),        CLASS_ID(CObservationDoorSigns), CLASS_ID(CObservationCommand),
  };
  return classes;
}

void registerClasses() {
  for (const auto* id : allClasses()) mrpt::rtti::registerClass(id);
}

// The build links this file last, so that the ids of the classes are initialized before.
const base::AtLoad kRegister(registerClasses);

}  // namespace omnimapper::obs
