// connectComponents() for the comparators of this library, compiled once.
#include <omnimapper/perception/ClusterComparator.h>
#include <omnimapper/perception/ColouredPlaneComparator.h>
#include <omnimapper/perception/RoadComparator.h>
#include <omnimapper/perception/SmoothComparator.h>

namespace omnimapper::perception {

template Components connectComponents(int, int, const ColouredPlaneComparator&);
template Components connectComponents(int, int, const ClusterComparator&);
template Components connectComponents(int, int, const RoadComparator&);
template Components connectComponents(int, int, const SmoothComparator&);

}  // namespace omnimapper::perception
