// The page of a run: what it shows while the map grows and when the run has ended, and what happens if its server
// falls.
#include <gtest/gtest.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/map/Layers.h>
#include <omnimapper/map/MapFile.h>
#include <omnimapper/map/Places.h>
#include <omnimapper/mapper/PluginRegistry.h>
#include <omnimapper/testing/Fixtures.h>
#include <signal.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <thread>

#include "../../server/Client.h"
#include "live_page/LivePage.h"

namespace live_page_test {
namespace {

namespace fs = std::filesystem;
namespace map = omnimapper::map;
namespace mapper = omnimapper::mapper;
using namespace omnimapper::plugins;
using nlohmann::json;

/// Long enough for a busy machine.
void waitUntil(const std::function<bool()>& holds) {
  for (int i = 0; i < 1200 && !holds(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(50));
}

/// The process of the server, which this process started; -1 if there is none.
pid_t serverProcess() {
  for (const auto& entry : fs::directory_iterator("/proc")) {
    std::ifstream status(entry.path() / "stat");
    pid_t process = 0, parent = 0;
    std::string name, state;
    if (status >> process >> name >> state >> parent && parent == ::getpid() && name == "(omnimapper-serv)")
      return process;
  }
  return -1;
}

class LivePageTest : public ::testing::Test {
 protected:
  LivePageTest() {
    options_.port = 0;
    options_.every = 0.1;
    context_.section = "page";
    context_.run_folder = folder_ / "run";
    context_.growing_folder = folder_ / "run/.omnimapper/growing";
    context_.say = [this](const std::string& sentence) { said_ += sentence + "\n"; };
    run_.map.sessions = {{0, "test", {}, true}};
  }
  /// The port that the page said that it has.
  std::uint16_t port() const {
    const std::string start = "http://127.0.0.1:";
    const auto at = said_.find(start);
    return at == std::string::npos ? 0 : static_cast<std::uint16_t>(std::stoi(said_.substr(at + start.size())));
  }
  json get(const std::string& path) const {
    omnimapper::server::Client client(port());
    client.send("GET " + path + " HTTP/1.1\r\nHost: 127.0.0.1:" + std::to_string(port()) +
                "\r\nConnection: close\r\n\r\n");
    const std::string answer = client.readAll();
    return json::parse(answer.substr(answer.find("\r\n\r\n") + 4), nullptr, false);
  }

  omnimapper::testing::ScratchFolder folder_;
  LivePageOptions options_;
  mapper::PluginContext context_;
  mapper::ViewedRun run_;
  std::string said_;
};

TEST_F(LivePageTest, ShowsTheMapWhileItGrowsAndThenTheFilesOfTheRun) {
  LivePage page(options_, context_);
  ASSERT_NE(port(), 0) << said_;
  EXPECT_TRUE(get("/api/map")["is_growing"]) << "there is no map yet";
  EXPECT_TRUE(get("/api/trajectory").empty());
  run_.map.key_frames.insert({});
  const auto sees = [&] {
    page.keyFrameAdded(run_.view());
    return get("/api/trajectory").size() == 1;
  };
  waitUntil(sees);
  EXPECT_EQ(get("/api/trajectory").size(), 1U) << said_;
  page.finish(run_.view());
  EXPECT_TRUE(page.isLookedAt());
  map::Places places;
  places.places.emplace_back();
  places.places.front().caption = "213";
  map::MapFile file;
  file.set(map::layerToSection(map::Places::kLayer, map::LayerOf<map::Places>(places)));
  file.write(context_.run_folder + "/map.omnimap");
  page.published(context_.run_folder);
  waitUntil([&] { return !get("/api/map")["is_growing"]; });
  EXPECT_EQ(get("/api/map")["places"][0]["caption"], "213");
  EXPECT_FALSE(fs::exists(context_.growing_folder));
}

// Changes of the map of before would be lost, and one that cannot be read is nothing for a run that replaces it.
TEST_F(LivePageTest, ShowsNoMapOfBeforeAndLeavesNothingBehind) {
  fs::create_directories(context_.run_folder);
  std::ofstream(context_.run_folder + "/map.omnimap") << "a map that cannot be read";
  {
    LivePage page(options_, context_);
    ASSERT_NE(port(), 0) << said_;
    EXPECT_TRUE(get("/api/map")["is_growing"]);
    page.published(context_.run_folder + "/interrupted");
    EXPECT_TRUE(fs::exists(context_.growing_folder)) << "the map of the run is not that of the folder";
  }
  EXPECT_FALSE(fs::exists(context_.run_folder + "/.omnimapper"));
}

TEST_F(LivePageTest, AMapThatCannotBeShownIsSaidOnceAndEndsNoRun) {
  fs::create_directories(fs::path(context_.growing_folder).parent_path());
  std::ofstream(context_.growing_folder) << "a file in the place of the folder";
  LivePage page(options_, context_);
  run_.map.key_frames.insert({});
  for (int i = 0; i < 15; ++i) {
    page.keyFrameAdded(run_.view());
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  EXPECT_NO_THROW(page.finish(run_.view()));
  const std::string problem = "does not show the newest map";
  const auto first = said_.find(problem);
  ASSERT_NE(first, std::string::npos) << said_;
  EXPECT_EQ(said_.find(problem, first + 1), std::string::npos) << said_;
}

TEST_F(LivePageTest, TheRunGoesOnWhenTheServerFallsAndSaysSo) {
  LivePage page(options_, context_);
  run_.map.key_frames.insert({});
  ASSERT_EQ(::kill(serverProcess(), SIGKILL), 0);
  waitUntil([&] {
    page.frameAdded(run_.view());
    return said_.find("signal 9") != std::string::npos;
  });
  EXPECT_NE(said_.find("the run goes on without the page"), std::string::npos) << said_;
  EXPECT_FALSE(page.isLookedAt());
  EXPECT_NO_THROW(page.finish(run_.view()));
  EXPECT_NO_THROW(page.published(context_.run_folder));
}

TEST_F(LivePageTest, TheServerEndsWithThePage) {
  { const LivePage page(options_, context_); }
  EXPECT_EQ(serverProcess(), -1);
}

TEST_F(LivePageTest, APortInUseIsAnErrorWithARemedy) {
  const LivePage first(options_, context_);
  options_.port = port();
  try {
    const LivePage second(options_, context_);
    FAIL() << "two pages have one port";
  } catch (const omnimapper::base::Error& error) {
    EXPECT_NE(std::string(error.what()).find("or choose another one"), std::string::npos) << error.what();
  }
}

TEST_F(LivePageTest, OnlyTheFirstIniAndTheCommandLineOpenAPort) {
  const auto put = [this](const std::string& name, const std::string& text) {
    std::ofstream(folder_ / name) << text;
    return folder_ / name;
  };
  using omnimapper::base::Config;
  const std::string own = put("own.ini", "[mapper]\noutput_plugins = page\n[page]\nclass = LivePage\n");
  const std::string port = put("port.ini", "[page]\nport = 80\n");
  const std::string empty = put("empty.ini", "[mapper]\nmotion = planar\n");
  const auto sections = [](const Config& config, const std::vector<std::string>& more = {}) {
    return mapper::outputSections(config, more);
  };
  EXPECT_EQ(sections(Config::fromFile(own)).made, std::vector<std::string>{"page"});
  const auto of_another = sections(Config::fromFiles({empty, own}));
  EXPECT_TRUE(of_another.made.empty());
  ASSERT_EQ(of_another.left_out.size(), 1U);
  EXPECT_NE(of_another.left_out[0].find("own.ini:2: [page] is left out"), std::string::npos) << of_another.left_out[0];
  EXPECT_TRUE(sections(Config::fromFiles({own, port})).made.empty());
  auto asked = Config::fromFiles({empty});
  asked.set("page.class=LivePage");
  EXPECT_EQ(sections(asked, {"page"}).made, std::vector<std::string>{"page"});
  const auto replayed =
      Config::fromFile(put("replay.ini", omnimapper::base::kWrittenFromALog +
                                             "\n[mapper]\noutput_plugins = page\n[page]\nclass = LivePage\n"));
  EXPECT_TRUE(sections(replayed).made.empty());
}

}  // namespace
}  // namespace live_page_test
