#include <gtest/gtest.h>
#include <omnimapper/base/AtomicFile.h>
#include <omnimapper/base/Config.h>
#include <omnimapper/testing/Fixtures.h>

#include <cmath>

namespace omnimapper::base::config_test {
namespace {

struct TriggerOptions {
  double distance = 0.5;
  double angle = 0.5;
  int every = 1;
  std::string label;

  static const OptionTable<TriggerOptions>& table() {
    static const auto table =
        OptionTable<TriggerOptions>()
            .number("distance_m", &TriggerOptions::distance, Range::positive(), "Distance travelled.")
            .number("angle_deg", &TriggerOptions::angle, {0, 180}, "Turn.")
            .integer("every", &TriggerOptions::every, {1, 10}, "Every n-th.")
            .text("label", &TriggerOptions::label, "Sensor.");
    return table;
  }
};

Config parsed(const std::string& text) {
  return Config::fromText(text, "test.ini");
}
TriggerOptions trigger(const std::string& text) {
  return parsed(text).section("trigger").read<TriggerOptions>();
}

// Runs `act` and checks the code of its error and that the message contains each of `words`.
void expectError(const std::function<void()>& act, ExitCode code, const std::vector<std::string>& words) {
  try {
    act();
    ADD_FAILURE() << "nothing was thrown";
  } catch (const Error& error) {
    EXPECT_EQ(static_cast<int>(error.code()), static_cast<int>(code)) << error.what();
    for (const auto& word : words) {
      EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << "'" << word << "' not in: " << error.what();
    }
  }
}

TEST(Config, ReadsValuesAndKeepsDefaultsOfKeysThatAreNotThere) {
  const auto options = trigger("[trigger]\ndistance_m = 1.5\nangle_deg=180\nlabel = front laser \n");
  EXPECT_EQ(options.distance, 1.5);
  EXPECT_DOUBLE_EQ(options.angle, 2 * std::acos(0.0));
  EXPECT_EQ(options.every, 1);
  EXPECT_EQ(options.label, "front laser");
}

TEST(Config, OfSeveralFilesTheLaterCountsOverTheEarlier) {
  const omnimapper::testing::ScratchFolder folder;
  const auto save = [&](const std::string& name, const std::string& text) {
    writeFile(folder / name, [&](std::ostream& out) { out << text; });
    return folder / name;
  };
  const auto first = save("first.ini", "[trigger]\ndistance_m = 1.5\nevery = 2\n");
  const auto over = save("over.ini", "[other]\nkey = 1\n[trigger]\nevery = 3  ; remark\n");
  const auto config = Config::fromFiles({first, over});
  const auto options = config.section("trigger").read<TriggerOptions>();
  EXPECT_EQ(options.distance, 1.5);
  EXPECT_EQ(options.every, 3);
  EXPECT_TRUE(config.has("other"));
  EXPECT_EQ(config.file(), first + " + " + over);
  EXPECT_FALSE(Config::fromFiles({}).has("trigger"));
  expectError([&] { Config::fromFiles({first, folder / "none.ini"}); }, ExitCode::unreadable_input, {"none.ini"});
}

TEST(Config, AMissingOrEmptySectionKeepsAllDefaults) {
  EXPECT_EQ(trigger("").distance, 0.5);
  EXPECT_EQ(trigger("[trigger]\n").distance, 0.5);
  EXPECT_EQ(trigger("# nothing but a remark\n").distance, 0.5);
}

TEST(Config, KnowsWhichSectionsItHas) {
  const Config config = parsed("[trigger]\n[mapper]\nwindow_s = 2\n");
  EXPECT_TRUE(config.has("mapper"));
  EXPECT_TRUE(config.has("trigger"));
  EXPECT_FALSE(config.has("walls"));
}

TEST(Config, CommentsStartWithAnyOfThreeSignsAfterABlank) {
  const auto options = trigger(
      "; a\n# b\n// c\n[trigger] # the trigger\ndistance_m = 2 // travel\nevery = 3 ; scans\nlabel = file://a#b;c\n");
  EXPECT_EQ(options.distance, 2);
  EXPECT_EQ(options.every, 3);
  EXPECT_EQ(options.label, "file://a#b;c");
}

TEST(Config, SignsInValuesStayAsTheyAre) {
  for (const std::string value : {"100 % $HOME", "a\\b", "\"quoted\"", "[a] = b"}) {
    const auto options = trigger("[trigger]\nlabel = " + value + "\nevery = 2\n");
    EXPECT_EQ(options.label, value);
    EXPECT_EQ(options.every, 2);
  }
}

TEST(Config, MrptsExpansionsWorkAndOnesThatFailAreErrorsWithFileAndLine) {
  ::setenv("OMNIMAPPER_CONFIG_TEST", "rear", 1);
  EXPECT_EQ(trigger("[trigger]\nlabel = $env{OMNIMAPPER_CONFIG_TEST}\n").label, "rear");
  EXPECT_EQ(trigger("[trigger]\ndistance_m = $eval{2*3}\n").distance, 6);
  expectError([] { trigger("# remark\n\n[trigger]\nlabel = ${NOBODY}\n"); }, ExitCode::wrong_type,
              {"test.ini", "Line 4", "NOBODY"});
}

TEST(Config, LinesOfWindowsAndAByteOrderMarkAreRead) {
  EXPECT_EQ(trigger("\xEF\xBB\xBF[trigger]\r\nevery = 4\r\n").every, 4);
}

TEST(Config, AnUnknownKeyNamesFileSectionKeyAndTheNearestKnownOne) {
  expectError([] { trigger("[trigger]\ndistence_m = 1\n"); }, ExitCode::unknown_key,
              {"test.ini:2: [trigger]", "'distence_m'", "'distance_m'"});
  expectError([] { trigger("[trigger]\nDistance_m = 1\n"); }, ExitCode::unknown_key, {"'distance_m'"});
  // If no name is close, all known names are listed.
  expectError([] { trigger("[trigger]\nxyzzyq = 1\n"); }, ExitCode::unknown_key,
              {"'xyzzyq'", "distance_m, angle_deg, every, label"});
}

TEST(Config, KeysThatSomebodyElseReadsArePassed) {
  const Config config = parsed("[trigger]\nclass = Trigger\nevery = 2\n");
  expectError([&] { config.section("trigger").read<TriggerOptions>(); }, ExitCode::unknown_key, {"'class'"});
  EXPECT_EQ(config.section("trigger").read<TriggerOptions>({"class"}).every, 2);
}

struct Searches {
  double min_travel = 1;

  static const OptionTable<Searches>& table() {
    static const auto table =
        OptionTable<Searches>().number("min_travel_m", &Searches::min_travel, Range::positive(), "Distance travelled.");
    return table;
  }
};

TEST(Config, ARenamedKeyIsAnsweredWithItsPresentName) {
  expectError([] { parsed("[loops]\nmin_way_m = 4\n").section("loops").read<Searches>(); }, ExitCode::unknown_key,
              {"test.ini:2", "[loops] has no key 'min_way_m'", "called 'min_travel_m' now"});
}

TEST(Config, FilesThatAProgramWroteKeepTheFormerNamesOfKeys) {
  const omnimapper::testing::ScratchFolder folder;
  const auto read = [&](const std::string& keys) {
    writeFile(folder / "run.ini", [&](std::ostream& out) { out << kWrittenFromALog << ".\n[loops]\n" << keys; });
    return Config::fromFile(folder / "run.ini").section("loops").read<Searches>().min_travel;
  };
  EXPECT_EQ(read("min_way_m = 4\n"), 4);
  EXPECT_EQ(read("min_travel_m = 5\n"), 5);
  expectError([&] { read("min_trvel_m = 5\n"); }, ExitCode::unknown_key, {"did you mean 'min_travel_m'?"});
  expectError([&] { read("min_way_m = -4\n"); }, ExitCode::out_of_range, {"min_travel_m", "-4"});
}

TEST(Config, AWrongTypeNamesFileSectionKeyValueAndDefault) {
  expectError([] { trigger("[trigger]\nevery = often\n"); }, ExitCode::wrong_type,
              {"test.ini:2: [trigger]", "every = 'often'", "whole number", "default 1"});
  expectError([] { trigger("[trigger]\nevery = 2.5\n"); }, ExitCode::wrong_type, {"2.5"});
  expectError([] { trigger("[trigger]\nevery =\n"); }, ExitCode::wrong_type, {"every = ''"});
}

TEST(Config, AValueOutOfRangeNamesTheRange) {
  expectError([] { trigger("; remark\n[trigger]\n\nangle_deg = 200\n"); }, ExitCode::out_of_range,
              {"test.ini:4: [trigger]", "angle_deg = '200'", "[0, 180]"});
  expectError([] { trigger("[trigger]\ndistance_m = -2\n"); }, ExitCode::out_of_range, {"> 0"});
}

TEST(Config, ADoubledKeyIsRefusedWithItsLine) {
  expectError([] { parsed("[trigger]\nevery = 1\n\nevery = 2\n"); }, ExitCode::unknown_key,
              {"test.ini:4:", "'every'", "twice", "[trigger]"});
  EXPECT_NO_THROW(parsed("[trigger]\nevery = 1\n[other]\nevery = 2\n"));
}

TEST(Config, ADoubledKeyIsRefusedInWhateverCase) {
  expectError([] { parsed("[trigger]\nevery = 1\nEvery = 2\n"); }, ExitCode::unknown_key, {"test.ini:3:", "twice"});
  Config config = parsed("[trigger]\nevery = 1\n");
  expectError([&] { config.set("trigger.Every=2"); }, ExitCode::unknown_key, {"--set", "'Every'", "'every'"});
  const omnimapper::testing::ScratchFolder folder;
  writeFile(folder / "first.ini", [](std::ostream& out) { out << "[trigger]\nevery = 1\n"; });
  writeFile(folder / "over.ini", [](std::ostream& out) { out << "[trigger]\nEVERY = 2\n"; });
  expectError(
      [&] {
        Config::fromFiles({folder / "first.ini", folder / "over.ini"});
      },
      ExitCode::unknown_key, {"over.ini:2", "'EVERY'", "'every'"});
}

TEST(Config, WhatTheUserWroteHimselfIsTrusted) {
  const omnimapper::testing::ScratchFolder folder;
  const std::string text = "[mapper]\nlibrary = x\n", first = folder / "first.ini", over = folder / "over.ini",
                    written = folder / "check.ini";
  writeFile(first, [&](std::ostream& out) { out << text; });
  writeFile(over, [&](std::ostream& out) { out << text; });
  writeFile(written, [&](std::ostream& out) { out << kWrittenFromALog << " by a program.\n" << text; });
  EXPECT_TRUE(Config::fromFile(first).isTrusted("mapper", "library"));
  EXPECT_TRUE(Config::fromFile(first).isTrusted("mapper", "nothing"));
  EXPECT_FALSE(Config::fromFile(written).isTrusted("mapper", "library"));
  auto config = Config::fromFiles({first, over});
  EXPECT_FALSE(config.isTrusted("Mapper", "Library"));
  config.set("mapper.library=y");
  EXPECT_TRUE(config.isTrusted("mapper", "library"));
  EXPECT_EQ(config.firstFile(), first);
}

TEST(Config, ADoubledSectionIsRefusedWithItsLineInWhateverCase) {
  expectError([] { parsed("[trigger]\n[mapper]\n[trigger]\n"); }, ExitCode::unknown_key,
              {"test.ini:3:", "[trigger]", "twice"});
  expectError([] { parsed("[trigger]\nevery = 1\n[Trigger]\nevery = 2\n"); }, ExitCode::unknown_key,
              {"test.ini:3:", "twice"});
}

TEST(Config, WhatIsNoTextIsProbablyALog) {
  for (const std::string& bytes : {std::string("\x1f\x8b\x08"), std::string("BZh91"), std::string("\x9fmrpt\0", 6)})
    expectError([&] { parsed(bytes); }, ExitCode::unknown_key,
                {"test.ini: is not a text file", "a log is given with -r"});
}

TEST(Config, ALineThatIsNeitherSectionNorKeyIsRefusedWithItsLine) {
  expectError([] { parsed("[trigger]\nevery 3\n"); }, ExitCode::unknown_key, {"test.ini:2:", "every 3"});
  expectError([] { parsed("every = 3\n[trigger]\n"); }, ExitCode::unknown_key, {"test.ini:1:"});
  expectError([] { parsed("[trigger\nevery = 3\n"); }, ExitCode::unknown_key, {"test.ini:1:"});
  expectError([] { parsed("[trigger]\n = 3\n"); }, ExitCode::unknown_key, {"test.ini:2:"});
}

TEST(Config, SettingsOfTheCommandLineReplaceAndAdd) {
  Config config = parsed("[trigger]\nevery = 2\n");
  config.set("trigger.every=5");
  config.set("trigger.label = a.b=c");
  config.set("mapper.window_s=2");
  const auto options = config.section("trigger").read<TriggerOptions>();
  EXPECT_EQ(options.every, 5);
  EXPECT_EQ(options.label, "a.b=c");
  EXPECT_TRUE(config.has("mapper"));
  EXPECT_NE(config.text().find("window_s"), std::string::npos);
}

TEST(Config, SettingsOfTheCommandLineMeetTheSameChecks) {
  Config config = parsed("[trigger]\n");
  config.set("trigger.evry=5");
  expectError([&] { config.section("trigger").read<TriggerOptions>(); }, ExitCode::unknown_key,
              {"--set trigger.evry: [trigger]", "'every'"});
  config = parsed("[trigger]\nevery = 3\n");
  config.set("trigger.every=often");
  expectError([&] { config.section("trigger").read<TriggerOptions>(); }, ExitCode::wrong_type,
              {"--set trigger.every: [trigger]", "'often'"});
  config.set("trigger.every=1");
  config.set("triger.every=1");
  config.section("trigger");
  expectError([&] { config.refuseUnreadSections(); }, ExitCode::unknown_key, {"--set triger.every: ", "'trigger'"});
}

TEST(Config, OfSeveralFilesThePlaceIsThatOfTheOneThatCounts) {
  const omnimapper::testing::ScratchFolder folder;
  writeFile(folder / "first.ini", [](std::ostream& out) { out << "[trigger]\nevery = 0\nangle_deg = 200\n"; });
  writeFile(folder / "over.ini", [](std::ostream& out) { out << "\n\n[trigger]\nevery = 0\n"; });
  const auto config = Config::fromFiles({folder / "first.ini", folder / "over.ini"});
  EXPECT_EQ(config.placeOf("trigger", "every"), folder / "over.ini:4");
  EXPECT_EQ(config.placeOf("Trigger", "angle_deg"), folder / "first.ini:3");
  EXPECT_EQ(config.placeOf("nowhere"), config.file());
}

TEST(Config, ASettingOfAnotherFormIsAnErrorOfTheCommandLine) {
  Config config = parsed("[trigger]\n");
  for (const char* text : {"", "every=3", "trigger.every", ".every=3", "trigger.=3", "trigger=a.b", "trigger. =3"}) {
    expectError([&] { config.set(text); }, ExitCode::command_line, {"--set", "section.key=value"});
  }
}

TEST(Config, ASectionThatNobodyReadIsRefusedWithTheNearestName) {
  const Config config = parsed("[trigger]\n[triger2]\nevery = 2\n");
  config.section("trigger");
  expectError([&] { config.refuseUnreadSections(); }, ExitCode::unknown_key,
              {"test.ini:2: ", "[triger2]", "'trigger'"});
  config.section("triger2");
  EXPECT_NO_THROW(config.refuseUnreadSections());
}

TEST(Config, WhatAnEarlierIniHasOrItsReaderKnowsPassesInTheNext) {
  const Config before = parsed("[trigger]\n[camera]\nrate_hz = 1\n");
  before.section("trigger");
  before.section("perception");
  const Config next = parsed("[trigger]\n[camera]\nrate_hz = 1\n[perception]\nthreads = 2\n");
  EXPECT_NO_THROW(next.refuseUnreadSections(before));
  const Config misspelt = parsed("[trigger]\n[triger2]\nevery = 2\n");
  expectError([&] { misspelt.refuseUnreadSections(before); }, ExitCode::unknown_key, {"[triger2]", "'trigger'"});
}

TEST(Config, DriverSectionsOfRawlogGrabberPass) {
  const Config config = parsed("[trigger]\n[LASER1]\ndriver = CHokuyoURG\nprocess_rate = 90\n");
  config.section("trigger");
  EXPECT_NO_THROW(config.refuseUnreadSections());
}

TEST(Config, SectionsOfPluginsThatNobodyAskedForAreSwitchedOff) {
  const Config config = parsed("[trigger]\n[grid]\nclass = GridOutput\n[odometry]\nclass = OdometryPlugin\n");
  config.section("trigger");
  config.section("odometry");
  EXPECT_NO_THROW(config.refuseUnreadSections());
  EXPECT_EQ(config.switchedOffPlugins(), std::vector<std::string>{"grid"});
}

TEST(Config, ReadsFilesAndNamesTheOnesItCannotRead) {
  testing::ScratchFolder folder;
  writeFile(folder / "a.ini", [](std::ostream& out) { out << "[trigger]\nevery = 7\n"; });
  writeFile(folder / "empty.ini", [](std::ostream&) {});
  EXPECT_EQ(Config::fromFile(folder / "a.ini").section("trigger").read<TriggerOptions>().every, 7);
  EXPECT_EQ(Config::fromFile(folder / "a.ini").file(), folder / "a.ini");
  EXPECT_FALSE(Config::fromFile(folder / "empty.ini").has("trigger"));
  expectError([&] { Config::fromFile(folder / "missing.ini"); }, ExitCode::unreadable_input, {"missing.ini"});
  expectError([&] { Config::fromFile(folder.path()); }, ExitCode::unreadable_input, {folder.path()});
}

TEST(Config, NearestNameIsThatOfWhichItIsTheBeginning) {
  EXPECT_EQ(nearestName("rel", {"ate", "rpe", "relations"}), "relations");
  EXPECT_EQ(nearestName("re", {"ate", "rpe", "relations"}), "rpe") << "two letters begin too many words";
}

TEST(Config, NearestNameIsByEditDistanceOrNone) {
  const std::vector<std::string> names = {"odometry", "no_motion", "scan_matching"};
  EXPECT_EQ(nearestName("odometri", names), "odometry");
  EXPECT_EQ(nearestName("scan_maching", names), "scan_matching");
  EXPECT_EQ(nearestName("NoMotion", names), "no_motion");
  EXPECT_EQ(nearestName("gps", names), "");
  EXPECT_EQ(nearestName("anything", {}), "");
  // An edit distance of these would take hours.
  const std::string x(1'000'000, 'x'), y(1'000'000, 'y');
  EXPECT_EQ(nearestName(x, {y, "odometry"}), "");
  EXPECT_EQ(nearestName("odometri", {y, "odometry"}), "odometry");
}

}  // namespace
}  // namespace omnimapper::base::config_test
