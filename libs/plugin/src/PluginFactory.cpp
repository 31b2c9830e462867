#include <omnimapper/map/Corrections.h>
#include <omnimapper/map/Level.h>
#include <omnimapper/plugin/PlaceOnEarth.h>
#include <omnimapper/plugin/PluginFactory.h>

IMPLEMENTS_VIRTUAL_MRPT_OBJECT(PluginFactory, mrpt::rtti::CObject, omnimapper::mapper)
IMPLEMENTS_VIRTUAL_MRPT_OBJECT(PosePluginFactory, PluginFactory, omnimapper::mapper)
IMPLEMENTS_VIRTUAL_MRPT_OBJECT(MeasurementPluginFactory, PluginFactory, omnimapper::mapper)
IMPLEMENTS_VIRTUAL_MRPT_OBJECT(OutputPluginFactory, PluginFactory, omnimapper::mapper)
IMPLEMENTS_VIRTUAL_MRPT_OBJECT(ExtractorFactory, PluginFactory, omnimapper::mapper)

namespace omnimapper::mapper {

map::LayerRegistry layersOfNoPlugin() {
  map::LayerRegistry registry;
  registry.add<map::Level>();
  registry.add<PlaceOnEarth>();
  registry.add<map::Corrections>();
  return registry;
}

void registerFactoryBases() {
  mrpt::rtti::registerClass(CLASS_ID(PluginFactory));
  mrpt::rtti::registerClass(CLASS_ID(PosePluginFactory));
  mrpt::rtti::registerClass(CLASS_ID(MeasurementPluginFactory));
  mrpt::rtti::registerClass(CLASS_ID(OutputPluginFactory));
  mrpt::rtti::registerClass(CLASS_ID(ExtractorFactory));
}

}  // namespace omnimapper::mapper
