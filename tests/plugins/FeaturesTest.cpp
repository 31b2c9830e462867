// What the build knows of features and their plugins is what their libraries register.
#include <gtest/gtest.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/base/FeatureLibraries.h>
#include <omnimapper/mapper/Features.h>
#include <omnimapper/mapper/PluginRegistry.h>

#include <set>
#include <string>

namespace omnimapper::plugins::features_test {
namespace {

TEST(Features, EveryPluginThatIsNoOutputBelongsToOne) {
  mapper::loadFeatures();
  std::size_t plugins = 0;
  for (const auto& factory : mapper::registeredFactories()) {
    if (factory->kind() == mapper::PluginKind::output) continue;
    ++plugins;
    EXPECT_NE(base::featureOf(factory->name()), "")
        << "PLUGINS in the CMakeLists.txt of its feature lacks " << factory->name();
    EXPECT_EQ(base::whyUnavailable(factory->name()), "");
  }
  EXPECT_GT(plugins, 0U);
}

TEST(Features, WhatIsThereRegistersAllThatTheBuildKnowsOfIt) {
  mapper::loadFeatures();
  std::set<std::string> registered;
  for (const auto& factory : mapper::registeredFactories()) registered.insert(factory->name());
  for (const auto& plugin : base::namesOfFeatures(base::Registered::plugin)) {
    EXPECT_TRUE(registered.count(plugin) > 0 || !base::whyUnavailable(plugin).empty()) << plugin;
  }
}

TEST(Features, AFunctionIsLoadedWhenItIsAskedForOrTheErrorSaysHowToGetIt) {
  const auto functions = base::namesOfFeatures(base::Registered::function);
  EXPECT_FALSE(functions.empty());
  for (const auto& function : functions) {
    try {
      EXPECT_NE(base::functionOfFeature(function, "it cannot be called", "leave it out"), nullptr);
      EXPECT_EQ(base::whyUnavailable(function), "");
    } catch (const base::Error& error) {
      EXPECT_EQ(error.code(), base::ExitCode::plugin_library);
      EXPECT_NE(std::string(error.what()).find("it belongs to the feature"), std::string::npos) << error.what();
    }
  }
  EXPECT_THROW(base::functionOfFeature("omnimapperNothing", "it cannot be called", "leave it out"), base::Error);
}

TEST(Features, OfTheProjectKnowNoOtherClass) {
  EXPECT_EQ(base::featureOf("BeaconPlugin"), "");
  EXPECT_EQ(base::whyUnavailable("BeaconPlugin"), "");
}

}  // namespace
}  // namespace omnimapper::plugins::features_test
