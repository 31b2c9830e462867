#pragma once

#include <omnimapper/plugin/SharedSection.h>

#include <memory>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace omnimapper::mapper {

/// The abstract factory of plugins of the kind that `Made` is.
template <class Made>
using AbstractFactoryOf =
    std::conditional_t<std::is_base_of_v<PosePlugin, Made>, PosePluginFactory,
                       std::conditional_t<std::is_base_of_v<MeasurementPlugin, Made>, MeasurementPluginFactory,
                                          std::conditional_t<std::is_base_of_v<OutputPlugin, Made>, OutputPluginFactory,
                                                             ExtractorFactory>>>;

/// Whether a struct of options says which other sections of the INI the plugin reads (sectionsRead()).
template <class Struct, class = void>
constexpr bool kReadsSections = false;
template <class Struct>
constexpr bool kReadsSections<Struct, std::void_t<decltype(std::declval<Struct>().sectionsRead())>> = true;

/// Whether a plugin class has a constant kNeedsTrust, which is true.
template <class Made, class = void>
constexpr bool kIsForTrustedInis = false;
template <class Made>
constexpr bool kIsForTrustedInis<Made, std::void_t<decltype(Made::kNeedsTrust)>> = Made::kNeedsTrust;

/// The factory of a plugin class, by which an INI can name it. The constructor of `Made` takes one or more structs of
/// options, and after them, if it must know the run, the context: `Made(const Structs&..., const PluginContext&)`. Its
/// section of the INI has the keys of all these structs, in that order. `Made` has two constants: kName is the name
/// after "class =" in an INI, and kSummary is one sentence for --list-plugins. A struct with a
/// function sectionsRead() names the sections that the plugin reads beside its own.
template <class Made, class... Structs>
class FactoryOf : public AbstractFactoryOf<Made> {
 public:
  using Plugin = typename AbstractFactoryOf<Made>::Plugin;

  static void registerClass() {
    registerFactoryBases();
    mrpt::rtti::registerClass(&GetRuntimeClassIdStatic());
  }

  std::string name() const override { return Made::kName; }
  std::string summary() const override { return Made::kSummary; }
  const std::vector<base::OptionSpec>& options() const override { return SharedSection<Structs...>::options(); }
  bool needsTrust() const override { return kIsForTrustedInis<Made>; }
  void registerKinds([[maybe_unused]] Kinds& kinds) const override {
    if constexpr (std::is_base_of_v<MeasurementPlugin, Made>) Made::registerKinds(kinds);
  }
  std::vector<std::string> sectionsReadBy([[maybe_unused]] const base::ConfigSection& section) const override {
    std::vector<std::string> sections;
    [[maybe_unused]] const auto add = [&](auto* type) {
      using Struct = std::remove_pointer_t<decltype(type)>;
      if constexpr (kReadsSections<Struct>)
        for (auto& read : SharedSection<Structs...>::template read<Struct>(section).sectionsRead())
          sections.push_back(std::move(read));
    };
    (add(static_cast<Structs*>(nullptr)), ...);
    return sections;
  }
  std::unique_ptr<Plugin> make(const base::ConfigSection& section,
                               [[maybe_unused]] const PluginContext& context) const override {
    using Section = SharedSection<Structs...>;
    if constexpr (std::is_constructible_v<Made, const Structs&..., const PluginContext&>)
      return std::make_unique<Made>(Section::template read<Structs>(section)..., context);
    else
      return std::make_unique<Made>(Section::template read<Structs>(section)...);
  }

  // This is what MRPT's macros generate for a run-time class; the macros do not support templates.
  static const mrpt::rtti::TRuntimeClassId& GetRuntimeClassIdStatic() {
    static const std::string class_name = std::string("omnimapper::mapper::FactoryOf:") + Made::kName;
    static const mrpt::rtti::TRuntimeClassId id{class_name.c_str(), &create, &baseClass};
    return id;
  }
  const mrpt::rtti::TRuntimeClassId* GetRuntimeClass() const override { return &GetRuntimeClassIdStatic(); }
  mrpt::rtti::CObject* clone() const override { return new FactoryOf(*this); }

 private:
  static std::shared_ptr<mrpt::rtti::CObject> create() { return std::make_shared<FactoryOf>(); }
  static const mrpt::rtti::TRuntimeClassId* baseClass() { return CLASS_ID(AbstractFactoryOf<Made>); }
};

}  // namespace omnimapper::mapper
