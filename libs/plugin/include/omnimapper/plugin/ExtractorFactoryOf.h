#pragma once

#include <omnimapper/plugin/SharedSection.h>

#include <memory>
#include <string>
#include <vector>

namespace omnimapper::mapper {

/// The factory of an extractor whose constructor takes structs of options: `Made(const Structs&...)`. Its section of
/// the INI has the keys of all these structs, in that order. `Made` has two constants: kName is the name after
/// "class =" in an INI, and kSummary is one sentence for --list-plugins.
template <class Made, class... Structs>
class ExtractorFactoryOf : public ExtractorFactory {
 public:
  static void registerClass() { mrpt::rtti::registerClass(&GetRuntimeClassIdStatic()); }

  std::string name() const override { return Made::kName; }
  std::string summary() const override { return Made::kSummary; }
  const std::vector<base::OptionSpec>& options() const override { return SharedSection<Structs...>::options(); }
  std::unique_ptr<perception::Extractor> make(const base::ConfigSection& section, const PluginContext&) const override {
    return std::make_unique<Made>(SharedSection<Structs...>::template read<Structs>(section)...);
  }

  // This is what MRPT's macros generate for a run-time class; the macros do not support templates.
  static const mrpt::rtti::TRuntimeClassId& GetRuntimeClassIdStatic() {
    static const std::string class_name = std::string("omnimapper::mapper::ExtractorFactoryOf:") + Made::kName;
    static const mrpt::rtti::TRuntimeClassId id{class_name.c_str(), &create, &baseClass};
    return id;
  }
  const mrpt::rtti::TRuntimeClassId* GetRuntimeClass() const override { return &GetRuntimeClassIdStatic(); }
  mrpt::rtti::CObject* clone() const override { return new ExtractorFactoryOf(*this); }

 private:
  static std::shared_ptr<mrpt::rtti::CObject> create() { return std::make_shared<ExtractorFactoryOf>(); }
  static const mrpt::rtti::TRuntimeClassId* baseClass() { return CLASS_ID(ExtractorFactory); }
};

}  // namespace omnimapper::mapper
