#include <omnimapper/base/FeatureLibraries.h>
#include <omnimapper/source/SourceFactory.h>

#include <algorithm>

IMPLEMENTS_VIRTUAL_MRPT_OBJECT(SourceFactory, mrpt::rtti::CObject, omnimapper::source)

namespace omnimapper::source {

std::vector<std::shared_ptr<const SourceFactory>> registeredFormats() {
  base::loadFeaturesOf(base::Registered::format);
  registerSourceFactory();
  mrpt::rtti::registerAllPendingClasses();
  std::vector<std::shared_ptr<const SourceFactory>> formats;
  for (const auto* id : mrpt::rtti::getAllRegisteredClassesChildrenOf(CLASS_ID(SourceFactory))) {
    if (!id->ptrCreateObject) continue;  // SourceFactory itself
    if (auto format = std::dynamic_pointer_cast<const SourceFactory>(id->createObject()))
      formats.push_back(std::move(format));
  }
  std::sort(formats.begin(), formats.end(), [](const auto& a, const auto& b) { return a->name() < b->name(); });
  return formats;
}

std::string sectionOfFormat(const std::string& format) {
  return "source_" + format;
}

void registerSourceFactory() {
  mrpt::rtti::registerClass(CLASS_ID(SourceFactory));
}

}  // namespace omnimapper::source
