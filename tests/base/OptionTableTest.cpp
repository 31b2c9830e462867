#include <gtest/gtest.h>
#include <omnimapper/base/OptionTable.h>

#include <cmath>

namespace omnimapper::base::option_table_test {
namespace {

enum class Metric { point, line };

struct Options {
  double distance = 0.5;
  double angle = 30 * option_text::kRadiansPerDegree;
  double share = 0.25;
  int count = 10;
  bool robust = true;
  std::string label = "laser";
  std::vector<std::string> plugins = {"odometry", "walls"};
  Metric metric = Metric::line;

  static const OptionTable<Options>& table() {
    static const auto table =
        OptionTable<Options>()
            .number("distance_m", &Options::distance, Range::positive(), "Distance travelled.")
            .number("angle_deg", &Options::angle, {0, 180}, "Turn.")
            .number("share", &Options::share, {0, 1}, "Share.")
            .integer("count", &Options::count, {1, 100}, "Count.")
            .flag("robust", &Options::robust, "Robust loss.")
            .text("label", &Options::label, "Sensor label.")
            .list("plugins", &Options::plugins, "Names.")
            .choice("metric", &Options::metric, {{"point", Metric::point}, {"line", Metric::line}}, "Metric.");
    return table;
  }
};

// Index of a key in the table.
std::size_t indexOf(const std::string& key) {
  const auto& specs = Options::table().specs();
  for (std::size_t i = 0; i < specs.size(); ++i) {
    if (specs[i].key == key) return i;
  }
  ADD_FAILURE() << "no key " << key;
  return 0;
}

std::unique_ptr<BadValue> set(Options& options, const std::string& key, const std::string& text) {
  return Options::table().set(options, indexOf(key), text);
}

TEST(OptionTable, PrintsKeyTypeDefaultAndRangeAsAUserWritesThem) {
  const auto& specs = Options::table().specs();
  const std::vector<std::vector<std::string>> expected = {
      {"distance_m", "number", "0.5", "> 0"},     {"angle_deg", "number", "30", "[0, 180]"},
      {"share", "number", "0.25", "[0, 1]"},      {"count", "integer", "10", "[1, 100]"},
      {"robust", "flag", "true", "true | false"}, {"label", "text", "laser", ""},
      {"plugins", "list", "odometry, walls", ""}, {"metric", "choice", "line", "point | line"},
  };
  ASSERT_EQ(specs.size(), expected.size());
  for (std::size_t i = 0; i < specs.size(); ++i) {
    EXPECT_EQ((std::vector<std::string>{specs[i].key, specs[i].type, specs[i].default_value, specs[i].range}),
              expected[i]);
    EXPECT_FALSE(specs[i].help.empty());
  }
}

TEST(OptionTable, EveryDefaultIsAcceptedBackAndChangesNothing) {
  for (const auto& spec : Options::table().specs()) {
    Options options;
    EXPECT_FALSE(set(options, spec.key, spec.default_value)) << spec.key;
    EXPECT_EQ(options.distance, 0.5);
    EXPECT_NEAR(options.angle, Options().angle, 1e-15);
    EXPECT_EQ(options.count, 10);
    EXPECT_EQ(options.plugins, Options().plugins);
    EXPECT_EQ(options.metric, Metric::line);
  }
}

TEST(OptionTable, DegreesOfTheFileAreRadiansInMemory) {
  Options options;
  EXPECT_FALSE(set(options, "angle_deg", "90"));
  EXPECT_DOUBLE_EQ(options.angle, std::acos(0.0));
  EXPECT_FALSE(set(options, "distance_m", "90"));
  EXPECT_EQ(options.distance, 90);
}

TEST(OptionTable, BoundsAreInTheUnitOfTheKeyAndInclusive) {
  Options options;
  EXPECT_FALSE(set(options, "angle_deg", "180"));
  EXPECT_FALSE(set(options, "count", "1"));
  EXPECT_FALSE(set(options, "count", "100"));
  for (const auto& [key, text] : {std::pair{"angle_deg", "180.1"},
                                  {"share", "-0.01"},
                                  {"count", "0"},
                                  {"count", "101"},
                                  {"distance_m", "0"},
                                  {"distance_m", "-1"}}) {
    const auto bad = set(options, key, text);
    ASSERT_TRUE(bad) << key << " = " << text;
    EXPECT_EQ(bad->kind, BadValue::Kind::range) << key << " = " << text;
  }
}

TEST(OptionTable, TextThatIsNoNumberIsAWrongTypeAndLeavesTheMemberAlone) {
  for (const auto& [key, text] : {std::pair{"share", "half"},
                                  {"share", ""},
                                  {"share", "0.5m"},
                                  {"share", "0,5"},
                                  {"share", "nan"},
                                  {"share", "inf"},
                                  {"share", "+-0.5"},
                                  {"count", "3.0"},
                                  {"count", "3 4"},
                                  {"robust", "maybe"},
                                  {"robust", ""},
                                  {"metric", "plane"}}) {
    Options options;
    const auto bad = set(options, key, text);
    ASSERT_TRUE(bad) << key << " = '" << text << "'";
    EXPECT_EQ(bad->kind, BadValue::Kind::type) << key << " = '" << text << "'";
    EXPECT_FALSE(bad->expected.empty());
    EXPECT_EQ(options.share, 0.25);
    EXPECT_EQ(options.count, 10);
    EXPECT_TRUE(options.robust);
    EXPECT_EQ(options.metric, Metric::line);
  }
}

TEST(OptionTable, ReadsSignsAndExponents) {
  Options options;
  EXPECT_FALSE(set(options, "share", "+2.5e-1"));
  EXPECT_EQ(options.share, 0.25);
  EXPECT_FALSE(set(options, "distance_m", "1E3"));
  EXPECT_EQ(options.distance, 1000);
  EXPECT_FALSE(set(options, "count", "+7"));
  EXPECT_EQ(options.count, 7);
}

TEST(OptionTable, ReadsFlagsChoicesAndLists) {
  Options options;
  EXPECT_FALSE(set(options, "robust", "no"));
  EXPECT_FALSE(options.robust);
  EXPECT_FALSE(set(options, "robust", "1"));
  EXPECT_TRUE(options.robust);
  EXPECT_FALSE(set(options, "metric", "point"));
  EXPECT_EQ(options.metric, Metric::point);
  EXPECT_FALSE(set(options, "plugins", " a,b  c ,, d"));
  EXPECT_EQ(options.plugins, (std::vector<std::string>{"a", "b", "c", "d"}));
  EXPECT_FALSE(set(options, "plugins", ""));
  EXPECT_TRUE(options.plugins.empty());
}

TEST(OptionTable, ANumberWithoutADefaultStaysEmptyUnlessItIsSet) {
  struct AngleOptions {
    std::optional<double> angle;
  };
  const auto table = OptionTable<AngleOptions>().number("angle_deg", &AngleOptions::angle, {0, 180}, "Turn.");
  EXPECT_EQ(table.specs().front().default_value, "");
  AngleOptions options;
  EXPECT_FALSE(options.angle);
  EXPECT_TRUE(table.set(options, 0, "200"));
  EXPECT_FALSE(options.angle);
  EXPECT_FALSE(table.set(options, 0, "90"));
  ASSERT_TRUE(options.angle);
  EXPECT_NEAR(*options.angle, 90 * option_text::kRadiansPerDegree, 1e-15);
}

TEST(OptionTable, AnIntegerWithoutADefaultStaysEmptyUnlessItIsSet) {
  struct SessionOptions {
    std::optional<int> number;
  };
  const auto table = OptionTable<SessionOptions>().integer("number", &SessionOptions::number, {0, 9}, "Number.");
  EXPECT_EQ(table.specs().front().default_value, "");
  EXPECT_EQ(table.specs().front().type, "integer");
  SessionOptions options;
  EXPECT_TRUE(table.set(options, 0, "10"));
  EXPECT_TRUE(table.set(options, 0, "1.5"));
  EXPECT_FALSE(options.number);
  EXPECT_FALSE(table.set(options, 0, "0"));
  EXPECT_EQ(options.number, 0);
}

}  // namespace
}  // namespace omnimapper::base::option_table_test
