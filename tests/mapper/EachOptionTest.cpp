#include <gtest/gtest.h>
#include <omnimapper/mapper/EngineOptions.h>
#include <omnimapper/mapper/Features.h>
#include <omnimapper/mapper/PluginRegistry.h>
#include <omnimapper/testing/Fixtures.h>

#include <cstdlib>
#include <set>
#include <sstream>

// Sets every key of every plugin class, one after another.
namespace omnimapper::mapper::each_option_test {
namespace {

using base::ExitCode;

// A section that an option may name.
const std::string kAnother = "[something]\nclass = VisualOdometryPlugin\n";

// What reading the section says of a value; none if it was read, whether or not the plugin could be made of it.
std::optional<base::Error> refusal(const PluginFactory& factory, const std::string& key, const std::string& value) {
  const testing::ScratchFolder folder;
  const auto config =
      base::Config::fromText("[p]\nclass = " + factory.name() + "\n" + key + " = " + value + "\n" + kAnother, "ini");
  PluginContext context;
  context.section = "p";
  context.output_folder = folder.path();
  context.config_text = config.text();
  PluginSections sections;
  const std::vector<std::string> names{"p"};
  (factory.kind() == PluginKind::pose          ? sections.pose
   : factory.kind() == PluginKind::measurement ? sections.measurement
   : factory.kind() == PluginKind::extractor   ? sections.extractors
                                               : sections.output) = names;
  try {
    makePlugins(sections, config, context);
  } catch (const base::Error& error) {
    const std::set<ExitCode> of_reading{ExitCode::unknown_key, ExitCode::wrong_type, ExitCode::out_of_range};
    if (of_reading.count(error.code()) > 0) return error;
  }
  return std::nullopt;
}

std::string text(double number) {
  std::ostringstream out;
  out << number;
  return out.str();
}

// Values that an option of this type may have; at least one of them is not its default.
std::vector<std::string> valuesFor(const base::OptionSpec& spec) {
  if (spec.type == "flag") return {spec.default_value == "true" ? "false" : "true"};
  if (spec.type == "text" || spec.type == "list") return {"something"};
  if (spec.type == "choice") {
    std::vector<std::string> values;
    std::istringstream names(spec.range);
    for (std::string name; names >> name;)
      if (name != "|" && name != spec.default_value) values.push_back(name);
    return values;
  }
  const double standard = std::strtod(spec.default_value.c_str(), nullptr);
  if (spec.type == "integer") return {text(standard + 1), text(standard - 1), "1"};
  return {text(1.25 * standard), text(0.75 * standard), text(standard + 0.5), text(standard - 0.5), "1"};
}

class EachOption : public ::testing::Test {
 protected:
  void SetUp() override {
    loadFeatures();
    const std::set<std::string> slow{"LiveWindow", "DoorSignExtractor"};  // they open a window and read networks
    for (const auto& factory : registeredFactories())
      if (slow.count(factory->name()) == 0) factories_.push_back(factory);
  }
  std::vector<std::shared_ptr<const PluginFactory>> factories_;
};

TEST_F(EachOption, TakesAnotherValueThanItsDefault) {
  std::size_t count = 0;
  for (const auto& factory : factories_) {
    for (const auto& spec : factory->options()) {
      std::string refusals;
      bool is_taken = false;
      for (const auto& value : valuesFor(spec)) {
        const auto refused = refusal(*factory, spec.key, value);
        is_taken = is_taken || !refused;
        if (refused) refusals += std::string("\n") + refused->what();
      }
      EXPECT_TRUE(is_taken) << factory->name() << " " << spec.key << refusals;
      ++count;
    }
  }
  EXPECT_GT(count, 200U);
}

TEST_F(EachOption, RefusesWhatIsNoValueOfItsTypeAndNamesTheKey) {
  for (const auto& factory : factories_) {
    for (const auto& spec : factory->options()) {
      if (spec.type == "text" || spec.type == "list") continue;
      const auto refused = refusal(*factory, spec.key, "neither");
      ASSERT_TRUE(refused) << factory->name() << " " << spec.key;
      EXPECT_EQ(refused->code(), ExitCode::wrong_type) << factory->name() << " " << spec.key;
      EXPECT_NE(std::string(refused->what()).find(spec.key), std::string::npos) << refused->what();
    }
  }
}

TEST_F(EachOption, RefusesANumberBeyondItsBounds) {
  for (const auto& factory : factories_) {
    for (const auto& spec : factory->options()) {
      if ((spec.type != "number" && spec.type != "integer") || spec.range.empty()) continue;
      const auto refused = refusal(*factory, spec.key, "-2000000000");
      ASSERT_TRUE(refused) << factory->name() << " " << spec.key << " " << spec.range;
      EXPECT_EQ(refused->code(), ExitCode::out_of_range) << refused->what();
    }
  }
}

}  // namespace
}  // namespace omnimapper::mapper::each_option_test
