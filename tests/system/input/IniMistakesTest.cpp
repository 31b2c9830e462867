// Mistakes in an INI file: each has its exit code, and a message that names file, section, key, value and remedy.
#include "../Runs.h"

namespace {

using namespace runs;
using omnimapper::testing::ScratchFolder;

class IniMistakes : public ::testing::Test {
 protected:
  // The INI is checked before the log, so the log need not exist.
  Ended mapWith(const std::string& ini) {
    writeFile(ini_, ini);
    return graphslam({"-i", ini_, "-r", scratch_ / "none.rawlog", "-o", scratch_ / "map"});
  }
  std::string laser2d(const std::string& from, const std::string& to) const {
    std::string text = readFile(omnimapper::testing::sourceFile("ini/laser2d.ini"));
    const auto place = text.find(from);
    EXPECT_NE(place, std::string::npos) << from;
    return text.replace(place, from.size(), to);
  }
  /// ini/laser2d.ini with lines appended to it.
  std::string laser2dAnd(const std::string& more) const {
    return readFile(omnimapper::testing::sourceFile("ini/laser2d.ini")) + more;
  }
  void expectRefused(const std::string& ini, ExitCode code, Texts words) {
    words.push_back(ini_);
    EXPECT_TRUE(endedWith(code, mapWith(ini), words)) << ini;
    EXPECT_FALSE(fs::exists(scratch_ / "map"));
  }

  ScratchFolder scratch_;
  std::string ini_ = scratch_ / "mine.ini";
};

TEST_F(IniMistakes, MisspeltKeysAreRefusedWithTheNearest) {
  expectRefused(laser2d("distance_m = 0.6", "distanse_m = 1"), ExitCode::unknown_key,
                {"[trigger]", "'distanse_m'", "did you mean 'distance_m'"});
  expectRefused(laser2d("class = OdometryPlugin", "class = OdometryPlugin\nlable = wheels"), ExitCode::unknown_key,
                {"[odometry]", "'lable'", "'label'"});
  expectRefused(laser2d("class = GridOutput", "class = GridOutput\nresolution = 0.1"), ExitCode::unknown_key,
                {"[grid]", "'resolution'", "'resolution_m'"});
}

TEST_F(IniMistakes, MisspeltSectionsAreRefusedWithTheNearest) {
  expectRefused(laser2dAnd("[triger]\ndistance_m = 1\n"), ExitCode::unknown_key, {"[triger]", "'trigger'"});
  expectRefused(laser2d("[odometry]", "[odometrie]"), ExitCode::unknown_plugin,
                {"[odometry]", "class = ...", "there is no section"});
}

TEST_F(IniMistakes, WhatStandsTwiceOrOutsideOfASectionIsRefusedWithItsLine) {
  expectRefused("[trigger]\ndistance_m = 1\n[mapper]\n[trigger]\n", ExitCode::unknown_key, {":4:", "[trigger]"});
  expectRefused("[trigger]\ndistance_m = 1\ndistance_m = 2\n", ExitCode::unknown_key, {":3:", "distance_m"});
  expectRefused("distance_m = 1\n", ExitCode::unknown_key, {":1:", "distance_m"});
  expectRefused("[trigger]\ndistance_m\n", ExitCode::unknown_key, {":2:", "key = value"});
}

TEST_F(IniMistakes, WrongTypesAreRefusedWithWhatIsExpected) {
  expectRefused(laser2d("distance_m = 0.6", "distance_m = far"), ExitCode::wrong_type,
                {"[trigger] distance_m", "'far'", "a number", "default"});
  expectRefused(laser2d("distance_m = 0.6", "every_observation = perhaps"), ExitCode::wrong_type,
                {"every_observation", "'perhaps'", "true or false"});
  expectRefused(laser2d("= planar", "= flying"), ExitCode::wrong_type, {"[mapper] motion", "'flying'", "planar"});
  expectRefused(laser2d("distance_m = 0.6", "distance_m = nan"), ExitCode::wrong_type, {"'nan'", "a number"});
}

TEST_F(IniMistakes, ValuesOutOfRangeAreRefusedWithTheRange) {
  expectRefused(laser2d("distance_m = 0.6", "distance_m = -1"), ExitCode::out_of_range,
                {"[trigger] distance_m", "'-1'", "must be", "default"});
  expectRefused(laser2d("class = LoopClosurePlugin", "class = LoopClosurePlugin\nmin_overlap = 1.5"),
                ExitCode::out_of_range, {"[loop_closure] min_overlap", "'1.5'", "[0, 1]"});
}

TEST_F(IniMistakes, UnknownPluginsAreRefusedWithTheNearest) {
  expectRefused(laser2d("class = OdometryPlugin", "class = OdometriePlugin"), ExitCode::unknown_plugin,
                {"[odometry]", "'OdometriePlugin'", "did you mean 'OdometryPlugin'"});
  expectRefused(laser2d("class = OdometryPlugin", "class = GridOutput"), ExitCode::unknown_plugin,
                {"[odometry]", "no pose plugin is called 'GridOutput'"});
  expectRefused(laser2d("odometry, no_motion", "odometry, no_motion, magic"), ExitCode::unknown_plugin,
                {"[magic]", "class = ..."});
  EXPECT_TRUE(endedWith(ExitCode::unknown_plugin, mapWith(laser2d("= scan_odometry, odometry, no_motion", "=")),
                        {"[mapper] names no pose_plugins", "--list-plugins"}));
}

TEST_F(IniMistakes, PluginLibrariesThatCannotBeLoadedAreRefusedByName) {
  const auto refused = [&](const std::string& library) {
    const std::string ini = laser2d("motion ", "plugin_libraries = " + library + "\nmotion ");
    EXPECT_TRUE(endedWith(ExitCode::plugin_library, mapWith(ini), {library, "plugin_libraries", "full path"}));
  };
  refused("libnobody-has-this.so");
  refused(writeFile(scratch_ / "libtext.so", "I am no library.\n"));
}

TEST_F(IniMistakes, AnIniThatCannotBeReadIsRefusedByName) {
  for (const std::string& path : {scratch_ / "missing.ini", scratch_.path()}) {
    EXPECT_TRUE(endedWith(ExitCode::unreadable_input, graphslam({"-i", path, "-r", "x", "-o", scratch_ / "map"}),
                          {path, "INI"}));
  }
}

TEST_F(IniMistakes, SettingsOfTheCommandLineAreCheckedAlike) {
  const auto refused = [&](const std::string& setting, ExitCode code, const Texts& words) {
    EXPECT_TRUE(endedWith(code, map({scratch_ / "none.rawlog"}, scratch_ / "map", {"--set", setting}), words));
  };
  refused("trigger.distanse_m=1", ExitCode::unknown_key, {"'distance_m'"});
  refused("triger.distance_m=1", ExitCode::unknown_key, {"'trigger'"});
  refused("trigger.distance_m=far", ExitCode::wrong_type, {"'far'"});
  refused("trigger.distance_m=0", ExitCode::out_of_range, {"'0'"});
  refused("odometry.class=OdometryPlugins", ExitCode::unknown_plugin, {"'OdometryPlugin'"});
}

}  // namespace
