#include <omnimapper/plugin/PluginFactory.h>

IMPLEMENTS_VIRTUAL_MRPT_OBJECT(PluginFactory, mrpt::rtti::CObject, omnimapper::mapper)
IMPLEMENTS_VIRTUAL_MRPT_OBJECT(PosePluginFactory, PluginFactory, omnimapper::mapper)
IMPLEMENTS_VIRTUAL_MRPT_OBJECT(MeasurementPluginFactory, PluginFactory, omnimapper::mapper)
IMPLEMENTS_VIRTUAL_MRPT_OBJECT(OutputPluginFactory, PluginFactory, omnimapper::mapper)
IMPLEMENTS_VIRTUAL_MRPT_OBJECT(ExtractorFactory, PluginFactory, omnimapper::mapper)
