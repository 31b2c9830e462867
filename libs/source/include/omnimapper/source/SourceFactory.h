#pragma once

#include <mrpt/rtti/CObject.h>
#include <omnimapper/base/Config.h>
#include <omnimapper/source/LogLook.h>
#include <omnimapper/source/ObservationSource.h>
#include <omnimapper/source/SourceOptions.h>

#include <memory>
#include <string>
#include <vector>

namespace omnimapper::source {

/// A format of logs, as an MRPT run-time class without state. A library registers its formats when it is loaded;
/// SourceOf makes one of a source class.
class SourceFactory : public mrpt::rtti::CObject {
  DEFINE_VIRTUAL_MRPT_OBJECT(SourceFactory)
 public:
  /// The name of the format, as [source] formats lists it; its options are in the section [source_NAME].
  virtual std::string name() const = 0;
  /// What such a log is, with its article: "a CARMEN log".
  virtual std::string summary() const = 0;
  virtual const std::vector<base::OptionSpec>& options() const = 0;
  /// Whether the log seems to be of this format. Must not throw, nor read more of the log than a few names.
  virtual bool recognizes(const LogLook& look) const = 0;
  /// Reads the options and returns what opens logs with them. Throws base::Error if the options are invalid.
  virtual OpenLog opener(const base::ConfigSection& section) const = 0;
};

/// Every format of the project's features, which are loaded for this, and of other libraries that were loaded, sorted
/// by name; rawlogs, which openLogs() knows itself, are not among them.
std::vector<std::shared_ptr<const SourceFactory>> registeredFormats();

/// The section of a format's options.
std::string sectionOfFormat(const std::string& format);

/// Registers the abstract factory with MRPT's run-time classes.
void registerSourceFactory();

/// The factory of a source class. `Made` has the constants kName and kSummary (see SourceFactory), a static function
/// recognizes(const LogLook&), and a constructor that takes the path and the struct of options.
template <class Made, class Options>
class SourceOf : public SourceFactory {
 public:
  static void registerClass() {
    registerSourceFactory();
    mrpt::rtti::registerClass(&GetRuntimeClassIdStatic());
  }

  std::string name() const override { return Made::kName; }
  std::string summary() const override { return Made::kSummary; }
  const std::vector<base::OptionSpec>& options() const override { return Options::table().specs(); }
  bool recognizes(const LogLook& look) const override { return Made::recognizes(look); }
  OpenLog opener(const base::ConfigSection& section) const override {
    return [options = section.template read<Options>()](const std::string& path) -> std::unique_ptr<ObservationSource> {
      return std::make_unique<Made>(path, options);
    };
  }

  // This is what MRPT's macros generate for a run-time class; the macros do not support templates.
  static const mrpt::rtti::TRuntimeClassId& GetRuntimeClassIdStatic() {
    static const std::string class_name = std::string("omnimapper::source::SourceOf:") + Made::kName;
    static const mrpt::rtti::TRuntimeClassId id{class_name.c_str(), &create, &baseClass};
    return id;
  }
  const mrpt::rtti::TRuntimeClassId* GetRuntimeClass() const override { return &GetRuntimeClassIdStatic(); }
  mrpt::rtti::CObject* clone() const override { return new SourceOf(*this); }

 private:
  static std::shared_ptr<mrpt::rtti::CObject> create() { return std::make_shared<SourceOf>(); }
  static const mrpt::rtti::TRuntimeClassId* baseClass() { return CLASS_ID(SourceFactory); }
};

}  // namespace omnimapper::source
