// connectComponents() for the comparators of this library, compiled once.
#include <omnimapper/perception/ClusterComparator.h>
#include <omnimapper/perception/ColouredPlaneComparator.h>

namespace omnimapper::perception {

template Components connectComponents(int, int, const PlaneComparator&);
template Components connectComponents(int, int, const ColouredPlaneComparator&);
template Components connectComponents(int, int, const ClusterComparator&);

}  // namespace omnimapper::perception
