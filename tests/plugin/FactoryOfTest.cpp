#include <gtest/gtest.h>
#include <omnimapper/plugin/FactoryOf.h>

namespace omnimapper::mapper::factory_of_test {
namespace {

struct Size {
  double size = 2;  // [m]

  static const base::OptionTable<Size>& table() {
    static const auto table = base::OptionTable<Size>().number("size_m", &Size::size, base::Range::positive(), "Size.");
    return table;
  }
};

struct Colour {
  std::string colour = "red";

  static const base::OptionTable<Colour>& table() {
    static const auto table = base::OptionTable<Colour>().text("colour", &Colour::colour, "Colour.");
    return table;
  }
};

class Balls : public MeasurementPlugin {
 public:
  static constexpr const char* kName = "Balls";
  static constexpr const char* kSummary = "Finds balls.";
  static void registerKinds(Kinds& kinds) { kinds.payloads.add("ball", {}); }

  Balls(const Size& size, const Colour& colour, const PluginContext& context)
      : size_m(size.size), colour(colour.colour), section(context.section) {}

  bool wants(const mrpt::obs::CObservation&) const override { return false; }
  Batch measure(const map::KeyFrame&, const Observed&, const View&) override { return {}; }

  double size_m;
  std::string colour, section;
};

class Drawing : public OutputPlugin {
 public:
  static constexpr const char* kName = "Drawing";
  static constexpr const char* kSummary = "Draws.";

  explicit Drawing(const Colour& colour) : colour(colour.colour) {}

  void finish(const View&) override {}

  std::string colour;
};

using BallsFactory = FactoryOf<Balls, Size, Colour>;
using DrawingFactory = FactoryOf<Drawing, Colour>;

TEST(FactoryOf, ReadsTheKeysOfAllStructsAndPassesTheContext) {
  const auto config = base::Config::fromText("[b]\nclass = Balls\nsize_m = 0.5\ncolour = blue\n", "test.ini");
  PluginContext context;
  context.section = "b";
  const auto made = BallsFactory().make(config.section("b"), context);
  const auto& balls = dynamic_cast<const Balls&>(*made);
  EXPECT_EQ(balls.size_m, 0.5);
  EXPECT_EQ(balls.colour, "blue");
  EXPECT_EQ(balls.section, "b");
}

TEST(FactoryOf, AConstructorWithoutContextIsEnough) {
  const auto config = base::Config::fromText("[d]\nclass = Drawing\n", "test.ini");
  const auto made = DrawingFactory().make(config.section("d"), {});
  EXPECT_EQ(dynamic_cast<const Drawing&>(*made).colour, "red");
}

TEST(FactoryOf, RefusesAKeyThatNoStructHas) {
  const auto config = base::Config::fromText("[b]\nclass = Balls\nweight_kg = 1\n", "test.ini");
  EXPECT_THROW(BallsFactory().make(config.section("b"), {}), base::Error);
}

TEST(FactoryOf, KnowsTheKindOfItsPluginsAndTheirOptions) {
  EXPECT_EQ(BallsFactory().kind(), PluginKind::measurement);
  EXPECT_EQ(DrawingFactory().kind(), PluginKind::output);
  EXPECT_EQ(BallsFactory().name(), "Balls");
  EXPECT_EQ(DrawingFactory().summary(), "Draws.");
  ASSERT_EQ(BallsFactory().options().size(), 2U);
  EXPECT_EQ(BallsFactory().options()[0].key, "size_m");
  EXPECT_EQ(BallsFactory().options()[1].key, "colour");
}

TEST(FactoryOf, RegistersTheKindsThatAMapMayHoldOfThePlugin) {
  Kinds kinds;
  BallsFactory().registerKinds(kinds);
  EXPECT_THROW(kinds.payloads.add("ball", {}), base::Error);
  EXPECT_NO_THROW(DrawingFactory().registerKinds(kinds));
}

TEST(FactoryOf, IsFoundByMrptOnceItIsRegistered) {
  BallsFactory::registerClass();
  const auto* found = mrpt::rtti::findRegisteredClass("omnimapper::mapper::FactoryOf:Balls");
  ASSERT_NE(found, nullptr);
  EXPECT_TRUE(found->derivedFrom(CLASS_ID(MeasurementPluginFactory)));
  EXPECT_TRUE(found->derivedFrom(CLASS_ID(PluginFactory)));
  EXPECT_NE(std::dynamic_pointer_cast<BallsFactory>(found->createObject()), nullptr);
}

}  // namespace
}  // namespace omnimapper::mapper::factory_of_test
