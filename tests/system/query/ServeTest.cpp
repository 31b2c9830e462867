// omnimapper-serve: what it says, what it refuses, and how it ends.
#include <omnimapper/map/Corrections.h>
#include <omnimapper/map/Labels.h>
#include <omnimapper/map/Layers.h>
#include <omnimapper/map/MapFile.h>
#include <omnimapper/map/Places.h>
#include <signal.h>

#include <chrono>
#include <nlohmann/json.hpp>
#include <thread>

#include "../../server/Client.h"
#include "../Runs.h"

namespace serve_test {
namespace {

using namespace runs;
namespace map = omnimapper::map;
using nlohmann::json;

/// The folder of a map with one sign.
class Serve : public ::testing::Test {
 protected:
  Serve() {
    map::Places places;
    map::Place sign;
    sign.kind = sign.label = "sign";
    sign.caption = "213";
    places.places = {sign};
    map::Map frames;
    frames.key_frames.insert({});
    map::MapFile file;
    file.set(map::framesToSection(frames));
    file.set(map::layerToSection(map::Places::kLayer, map::LayerOf<map::Places>(places)));
    file.write(folder_ / "map.omnimap");
  }
  static Texts command(Texts arguments) {
    arguments.insert(arguments.begin(), omnimapper::testing::ownProgram("omnimapper-serve"));
    return arguments;
  }

  omnimapper::testing::ScratchFolder folder_;
};

TEST_F(Serve, ShowsTheMapUntilCtrlC) {
  omnimapper::testing::Program program(command({folder_.path(), "--port", "0"}));
  ASSERT_TRUE(program.waitUntilIdle()) << toString(program.wait());
  const std::string said = program.printedSoFar();
  const auto at = said.find("http://127.0.0.1:");
  ASSERT_NE(at, std::string::npos) << said;
  const auto port = static_cast<std::uint16_t>(std::stoi(said.substr(at + 17)));
  const auto get = [&](const std::string& path) {
    omnimapper::server::Client client(port);
    client.send("GET " + path + " HTTP/1.1\r\nHost: 127.0.0.1:" + std::to_string(port) +
                "\r\nConnection: close\r\n\r\n");
    return client.readAll();
  };
  EXPECT_NE(get("/").find("<canvas"), std::string::npos) << "the page that comes with the program";
  for (const char* script : {"/app.js", "/plan.js", "/panel.js", "/style.css"})
    EXPECT_EQ(get(script).substr(0, 12), "HTTP/1.1 200") << script;
  EXPECT_NE(get("/api/map").find("\"caption\":\"213\""), std::string::npos);
  program.send(SIGINT);
  EXPECT_TRUE(endedWith(ExitCode::ok, program.wait()));
}

/// A server and what it said.
class RunningServer {
 public:
  RunningServer(const Texts& command, const ProgramOptions& options = {}) : program_(command, options) {
    EXPECT_TRUE(program_.waitUntilIdle()) << toString(program_.wait());
    const std::string said = program_.printedSoFar(), start = "http://127.0.0.1:", token = "token=";
    const auto port = said.find(start), at = said.find(token);
    if (port == std::string::npos || at == std::string::npos) throw std::runtime_error(said);
    port_ = static_cast<std::uint16_t>(std::stoi(said.substr(port + start.size())));
    token_ = said.substr(at + token.size(), 32);
  }
  /// Sends a change of labels; `read` takes the answer.
  template <class Read>
  void label(const json& words, Read read) {
    post("/api/label", words, read);
  }
  template <class Read>
  void post(const std::string& address, const json& words, Read read) {
    const std::string host = "127.0.0.1:" + std::to_string(port_), body = json{{"words", words}}.dump();
    omnimapper::server::Client client(port_);
    client.send("POST " + address + " HTTP/1.1\r\nHost: " + host + "\r\nOrigin: http://" + host +
                "\r\nContent-Type: application/json\r\nCookie: omnimapper_token=" + token_ +
                "\r\nContent-Length: " + std::to_string(body.size()) + "\r\n\r\n" + body);
    read(client);
  }
  /// Whether it confirms a change.
  bool confirms(const std::string& address, const json& words) {
    bool is_confirmed = false;
    post(address, words,
         [&](auto& client) { is_confirmed = client.readTo("\"done\"").find("\"done\"") != std::string::npos; });
    return is_confirmed;
  }
  void kill() {
    program_.send(SIGKILL);
    program_.wait();
  }

 private:
  omnimapper::testing::Program program_;
  std::uint16_t port_ = 0;
  std::string token_;
};

TEST_F(Serve, KeepsEachNameThatItConfirmedWhenItIsKilled) {
  std::vector<std::string> confirmed;
  for (int round = 0; round < 3; ++round) {
    RunningServer server(command({folder_.path(), "--port", "0"}));
    for (int i = 0; i < 10; ++i) {
      const std::string name = "name " + std::to_string(round) + "." + std::to_string(i);
      server.label({"name", "1", "2", name}, [&](auto& client) {
        if (client.readTo("is called").find("is called") != std::string::npos) confirmed.push_back(name);
      });
    }
    server.label({"name", "1", "2", "unconfirmed"}, [&](auto&) { server.kill(); });
    const auto file = map::MapFile::read(folder_ / "map.omnimap");
    std::set<std::string> kept;
    for (const auto& label : map::Labels::fromSection(*file.find(map::Labels::kLayer)).labels) kept.insert(label.text);
    for (const auto& name : confirmed) EXPECT_EQ(kept.count(name), 1U) << name;
  }
  EXPECT_EQ(confirmed.size(), 30U);
}

TEST_F(Serve, KeepsEachCorrectionAndUndoThatItConfirmedWhenItIsKilled) {
  for (int round = 0; round < 4; ++round) {
    const bool is_undone = round % 2 == 1, is_deleted = round < 2;
    const std::string name = "name " + std::to_string(round);
    RunningServer server(command({folder_.path(), "--port", "0"}));
    EXPECT_TRUE(server.confirms("/api/label", {"name", "1", "2", name}));
    if (is_undone) {
      EXPECT_TRUE(server.confirms("/api/label", {"undo"}));
    } else {
      EXPECT_TRUE(server.confirms("/api/correct", {is_deleted ? "delete" : "restore", "0:0"}));
    }
    server.label({"name", "1", "2", "unconfirmed"}, [&](auto&) { server.kill(); });
    const auto file = map::MapFile::read(folder_ / "map.omnimap");
    std::size_t count = 0;
    if (const auto* labels = file.find(map::Labels::kLayer))
      for (const auto& label : map::Labels::fromSection(*labels).labels) count += label.text == name;
    EXPECT_EQ(count, is_undone ? 0U : 1U) << name;
    EXPECT_EQ(file.find(map::Corrections::kLayer) != nullptr, is_deleted) << round;
  }
}

TEST_F(Serve, ChangesNothingOnAFullDiskAndSaysSo) {
  const std::string before = readFile(folder_ / "map.omnimap");
  ProgramOptions full;
  full.largest_file = before.size() / 2;
  RunningServer server(command({folder_.path(), "--port", "0"}), full);
  server.label({"name", "1", "2", "x"}, [&](auto& client) {
    const std::string answer = client.readTo("\r\n\r\n");
    EXPECT_NE(answer.find("507"), std::string::npos) << answer;
    EXPECT_EQ(answer.find(folder_.path()), std::string::npos) << answer;
  });
  EXPECT_EQ(readFile(folder_ / "map.omnimap"), before);
}

TEST_F(Serve, ARunShowsItsMapAndThePageStaysUntilCtrlC) {
  const std::string out = folder_ / "run";
  omnimapper::testing::Program program(mappingCommand(
      {omnimapper::testing::sourceFile("rawlogs/home_30s/home_30s.rawlog")}, out, {"--page", "--set", "page.port=0"}));
  for (int i = 0; i < 1200 && program.printedSoFar().find("Ctrl-C ends.") == std::string::npos; ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  const std::string said = program.saidSoFar(), start = "http://127.0.0.1:";
  const auto at = said.find(start);
  ASSERT_NE(at, std::string::npos) << said;
  const auto port = static_cast<std::uint16_t>(std::stoi(said.substr(at + start.size())));
  std::string map;
  for (int i = 0; i < 100 && map.find("\"is_growing\":false") == std::string::npos; ++i) {
    omnimapper::server::Client client(port);
    client.send("GET /api/map HTTP/1.1\r\nHost: 127.0.0.1:" + std::to_string(port) + "\r\nConnection: close\r\n\r\n");
    map = client.readAll();
  }
  EXPECT_NE(map.find("\"is_growing\":false"), std::string::npos) << map.substr(0, 2000);
  program.send(SIGINT);
  EXPECT_TRUE(endedWith(ExitCode::ok, program.wait()));
  EXPECT_FALSE(fs::exists(out + "/.omnimapper/growing"));
}

TEST_F(Serve, RefusesWhatOthersCouldReachAndWhatIsNoMap) {
  const auto ends = [&](ExitCode code, const Texts& arguments, const Texts& words) {
    EXPECT_TRUE(endedWith(code, omnimapper::testing::runProgram(command(arguments)), words));
  };
  ends(ExitCode::command_line, {folder_.path(), "--address", "0.0.0.0"}, {"0.0.0.0", "ssh -L", "doc/security.md"});
  ends(ExitCode::command_line, {folder_.path(), "--port", "70000"}, {"port"});
  ends(ExitCode::unreadable_input, {folder_ / "nothing"}, {"nothing"});
}

}  // namespace
}  // namespace serve_test
