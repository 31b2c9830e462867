// omnimapper-serve: what it says, what it refuses, and how it ends.
#include <omnimapper/map/Layers.h>
#include <omnimapper/map/MapFile.h>
#include <omnimapper/map/Places.h>
#include <signal.h>

#include "../../server/Client.h"
#include "../Runs.h"

namespace serve_test {
namespace {

using namespace runs;
namespace map = omnimapper::map;

/// The folder of a map with one sign.
class Serve : public ::testing::Test {
 protected:
  Serve() {
    map::Places places;
    map::Place sign;
    sign.kind = sign.label = "sign";
    sign.caption = "213";
    places.places = {sign};
    map::MapFile file;
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
