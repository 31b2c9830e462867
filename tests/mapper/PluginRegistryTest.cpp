#include <gtest/gtest.h>
#include <omnimapper/mapper/EngineOptions.h>
#include <omnimapper/mapper/Features.h>
#include <omnimapper/mapper/MappingRun.h>
#include <omnimapper/mapper/PluginHelp.h>
#include <omnimapper/mapper/PluginRegistry.h>
#include <omnimapper/testing/Fixtures.h>

#include <algorithm>
#include <fstream>
#include <functional>

namespace omnimapper::mapper::plugin_registry_test {
namespace {

bool holds(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

// The error that `work` throws; fails the test if it throws none.
base::Error errorOf(const std::function<void()>& work) {
  try {
    work();
  } catch (const base::Error& error) {
    return error;
  }
  ADD_FAILURE() << "nothing was thrown";
  return {base::ExitCode::ok, ""};
}

class PluginRegistry : public ::testing::Test {
 protected:
  void SetUp() override { mapper::loadFeatures(); }
};

TEST_F(PluginRegistry, FindsAClassOfItsKindOnly) {
  EXPECT_EQ(findFactory(PluginKind::pose, "OdometryPlugin", "here")->name(), "OdometryPlugin");
  const auto error = errorOf([] { findFactory(PluginKind::measurement, "OdometryPlugin", "here"); });
  EXPECT_EQ(error.code(), base::ExitCode::unknown_plugin);
}

TEST_F(PluginRegistry, AnUnknownClassIsAnsweredWithPlaceNearestAndKnownNames) {
  const auto error = errorOf([] { findFactory(PluginKind::pose, "OdometriePlugin", "my.ini: [odometry] class"); });
  EXPECT_EQ(error.code(), base::ExitCode::unknown_plugin);
  for (const std::string part : {"my.ini: [odometry] class", "'OdometriePlugin'", "did you mean 'OdometryPlugin'",
                                 "NoMotionPlugin", "pose plugin", "plugin_libraries"}) {
    EXPECT_TRUE(holds(error.what(), part)) << part << " is not in: " << error.what();
  }
  EXPECT_FALSE(holds(error.what(), "LoopClosurePlugin")) << "another kind: " << error.what();
}

TEST_F(PluginRegistry, AMissingLibraryIsAnsweredWithItsName) {
  const auto error = errorOf([] { loadPluginLibrary("/no/such/libmine.so"); });
  EXPECT_EQ(error.code(), base::ExitCode::plugin_library);
  EXPECT_TRUE(holds(error.what(), "/no/such/libmine.so")) << error.what();
  EXPECT_TRUE(holds(error.what(), "plugin_libraries")) << error.what();
}

TEST_F(PluginRegistry, AFileThatIsNoLibraryIsRefused) {
  const testing::ScratchFolder folder;
  std::ofstream(folder / "libtext.so") << "not a library\n";
  EXPECT_EQ(errorOf([&] { loadPluginLibrary(folder / "libtext.so"); }).code(), base::ExitCode::plugin_library);
}

TEST_F(PluginRegistry, MakesThePluginsOfAnIniInItsOrderUnderTheNamesOfTheirSections) {
  const auto config = base::Config::fromText(
      "[wheels]\nclass = OdometryPlugin\n[rest]\nclass = NoMotionPlugin\n[points]\nclass = LaserPointsExtractor\n"
      "[match]\nclass = LoopClosurePlugin\n[gps]\nclass = GpsPlugin\n",
      "my.ini");
  const auto set = makePlugins({{"rest", "wheels"}, {"points"}, {"gps", "match"}, {}}, config, {});
  ASSERT_EQ(set.pose.size(), 2U);
  EXPECT_EQ(set.pose[0].section, "rest");
  EXPECT_TRUE(set.pose[0].plugin->isFallback());
  EXPECT_EQ(set.pose[1].section, "wheels");
  EXPECT_FALSE(set.pose[1].plugin->isFallback());
  ASSERT_EQ(set.measurement.size(), 2U);
  EXPECT_EQ(set.measurement[0].section, "gps");
  EXPECT_EQ(set.measurement[1].section, "match");
  EXPECT_EQ(set.extractors.size(), 1U);
  EXPECT_TRUE(set.output.empty());
}

TEST_F(PluginRegistry, ASectionThatIsMissingOrHasNoClassIsNamed) {
  const auto config = base::Config::fromText("[wheels]\nlabel = odo\n", "my.ini");
  for (const std::string section : {"wheels", "wheel"}) {
    const auto error = errorOf([&] { makePlugins({{section}, {}, {}, {}}, config, {}); });
    EXPECT_EQ(error.code(), base::ExitCode::unknown_plugin);
    EXPECT_TRUE(holds(error.what(), "[" + section + "]")) << error.what();
    EXPECT_TRUE(holds(error.what(), "class")) << error.what();
    EXPECT_EQ(holds(error.what(), "there is no section"), section == "wheel") << error.what();
  }
}

TEST_F(PluginRegistry, APluginThatIsNamedTwiceIsRefused) {
  const auto config = base::Config::fromText("[points]\nclass = LaserPointsExtractor\n", "my.ini");
  const auto error = errorOf([&] { makePlugins({{}, {"points", "points"}, {}, {}}, config, {}); });
  EXPECT_EQ(error.code(), base::ExitCode::out_of_range);
  for (const std::string part : {"my.ini", "extractor [points]", "twice"})
    EXPECT_TRUE(holds(error.what(), part)) << error.what();
}

TEST_F(PluginRegistry, AWrongOptionOfAPluginIsRefusedWhenItIsMade) {
  const auto make = [](const std::string& line) {
    const auto config = base::Config::fromText("[m]\nclass = LoopClosurePlugin\n" + line + "\n", "my.ini");
    return errorOf([&] { makePlugins({{}, {}, {"m"}, {}}, config, {}); }).code();
  };
  EXPECT_EQ(make("min_overlapp = 0.5"), base::ExitCode::unknown_key);
  EXPECT_EQ(make("min_overlap = half"), base::ExitCode::wrong_type);
  EXPECT_EQ(make("min_overlap = 1.5"), base::ExitCode::out_of_range);
}

TEST_F(PluginRegistry, EveryClassIsListedWithItsSentence) {
  const std::string list = listPlugins();
  const auto factories = registeredFactories();
  EXPECT_GE(factories.size(), 6U);
  for (const auto& factory : factories) {
    EXPECT_TRUE(holds(list, "  " + factory->name() + " ")) << factory->name();
    EXPECT_TRUE(holds(list, factory->summary())) << factory->name();
    EXPECT_TRUE(holds(list, toString(factory->kind()) + "s\n")) << factory->name();
  }
}

// Expects that the printed section of the class has all its options, and makes the plugin from it. Throws as
// makePlugins() does. Output plugins are not made, because they need a folder; their own tests read their options.
void expectPrintedSection(const PluginFactory& factory) {
  const std::string ini = printIni(factory.name());
  EXPECT_TRUE(holds(ini, "class = " + factory.name() + "\n"));
  for (const auto& spec : factory.options()) {
    EXPECT_TRUE(holds(ini, "\n" + spec.key + " = " + spec.default_value)) << factory.name() << " " << spec.key;
    EXPECT_TRUE(holds(ini, spec.help)) << factory.name() << " " << spec.key;
  }
  const auto begin = ini.find('[') + 1;
  const std::string section = ini.substr(begin, ini.find(']') - begin);
  const auto config = base::Config::fromText(ini, "printed.ini");
  PluginSections sections;
  switch (factory.kind()) {
    case PluginKind::pose:
      sections.pose = {section};
      break;
    case PluginKind::measurement:
      sections.measurement = {section};
      break;
    case PluginKind::extractor:
      sections.extractors = {section};
      break;
    case PluginKind::output:
      return;
  }
  makePlugins(sections, config, {});
}

constexpr char kNeedsNetworks[] = "DoorSignExtractor";

TEST_F(PluginRegistry, PrintedSectionsHoldEveryOptionAndReadBackAsTheDefaults) {
  for (const auto& factory : registeredFactories()) {
    if (factory->name() == kNeedsNetworks) continue;
    EXPECT_NO_THROW(expectPrintedSection(*factory)) << factory->name();
  }
  const auto error = errorOf([] { printIni("LoopClosurPlugin"); });
  EXPECT_EQ(error.code(), base::ExitCode::unknown_plugin);
  EXPECT_TRUE(holds(error.what(), "did you mean 'LoopClosurePlugin'")) << error.what();
}

TEST_F(PluginRegistry, ThePrintedSectionOfAnExtractorWithNetworksReadsBackToo) {
  const auto factories = registeredFactories();
  const auto found = std::find_if(factories.begin(), factories.end(),
                                  [](const auto& factory) { return factory->name() == kNeedsNetworks; });
  if (found == factories.end()) GTEST_SKIP() << "this build has no door signs";
  try {
    expectPrintedSection(**found);
  } catch (const base::Error& error) {
    if (!holds(error.what(), "the network is missing")) throw;
    GTEST_SKIP() << error.what();
  }
}

TEST_F(PluginRegistry, TheReferenceHoldsEverySectionEveryClassAndEveryKey) {
  const std::string reference = iniReference(fixedSections());
  for (const auto& [name, specs] : fixedSections()) {
    EXPECT_TRUE(holds(reference, "## [" + name + "]"));
    for (const auto& spec : specs) EXPECT_TRUE(holds(reference, "| `" + spec.key + "` | ")) << name << spec.key;
  }
  for (const auto& factory : registeredFactories()) {
    EXPECT_TRUE(holds(reference, "## " + factory->name() + " (" + toString(factory->kind()) + ")"));
    for (const auto& spec : factory->options()) {
      EXPECT_TRUE(holds(reference, "| `" + spec.key + "` | " + spec.type)) << factory->name() << spec.key;
    }
  }
}

}  // namespace
}  // namespace omnimapper::mapper::plugin_registry_test
