#include <omnimapper/obs/CommandTable.h>

#include <filesystem>
#include <fstream>

#include "../query/MapWithFrames.h"
#include "omnimapper/server/MapSite.h"

namespace omnimapper::server::map_site_test {
namespace {

using nlohmann::json;

constexpr char kToken[] = "0123456789abcdef";

/// The page of the map of two rooms, in files.
class MapSiteTest : public query::MapWithFrames {
 protected:
  MapSiteTest() {
    building::Building building;
    building.storeys = {*map_.rooms};
    const std::string rooms = building::encodeRooms(building);
    EXPECT_NO_THROW(building::decodeRooms(rooms, "the rooms of the test"));
    query::putFile(folder_ / "rooms.json", rooms);
    write();
    query::putFile(folder_ / "trajectory.tum", "1 0.5 0.5 0 0 0 0 1\n2 1 1 0 0 0 0 1\nno numbers\n");
    std::filesystem::create_directory(folder_ / "page");
    query::putFile(folder_ / "page/index.html", "<p>the page</p>");
    query::putFile(folder_ / "page/secret.txt", "no page");
    std::filesystem::create_directory(folder_ / "objects");
    query::putFile(folder_ / "objects/0-1.png", "a picture");
    query::putFile(folder_ / "objects/secret.png", "no picture of a landmark");
  }
  MapSite site() {
    return {ServedMap(folder_.path()), StaticFiles(folder_ / "page"), Access({"map:8080"}, kToken),
            [] { return base::stampFromUnix(1700000000); }};
  }

  static HttpRequest get(const std::string& target) {
    HttpRequest request;
    EXPECT_TRUE(readTarget(target, request)) << target;
    request.method = "GET";
    request.host = "map:8080";
    return request;
  }
  /// The answer to a question, which another thread may make.
  static HttpResponse answered(MapSite& site, const std::string& target) {
    const auto response = site.answer(get(target));
    return response.later ? response.later() : response;
  }
  static HttpRequest edit(const json& words) { return change("/api/edit", words); }
  static HttpRequest change(const std::string& address, const json& words) {
    HttpRequest request = get(address);
    request.method = "POST";
    request.origin = "http://map:8080";
    request.content_type = "application/json";
    request.cookie = std::string("other=1; omnimapper_token=") + kToken;
    request.body = json{{"words", words}}.dump();
    return request;
  }
};

TEST_F(MapSiteTest, ThePageAndTheMapAreServed) {
  auto served = site();
  EXPECT_EQ(served.answer(get("/")).body, "<p>the page</p>");
  const auto map = json::parse(served.answer(get("/api/map")).body);
  EXPECT_EQ(map["rooms"].size(), 2U);
  EXPECT_EQ(map["rooms"][0]["outline_m"][1], (json{4, 0.1}));
  EXPECT_EQ(map["doors"][0]["rooms"][1]["id"], "room 2");
  EXPECT_EQ(map["unseen"][0]["name"], "118");
  EXPECT_EQ(map["places"].size(), 6U);
  EXPECT_EQ(map["places"][1]["room"]["name"], "kitchen");
  EXPECT_EQ(map["places"][5]["room"], nullptr);
  EXPECT_TRUE(map["places"][1]["has_picture"]);
  EXPECT_FALSE(map["places"][2]["has_picture"]);
  EXPECT_EQ(map["labels"]["bed"]["colour"], "#4f46e5");
  EXPECT_EQ(map["grid"]["columns"], 80);
  EXPECT_EQ(map["revision"], 1);
  EXPECT_EQ(map.count("map"), 0U) << "paths of this machine are not for pages";
  EXPECT_EQ(json::parse(served.answer(get("/api/trajectory")).body), (json{{0.5, 0.5}, {1, 1}}));
  EXPECT_EQ(served.answer(get("/api/grid")).body.substr(1, 3), "PNG");
  EXPECT_EQ(served.answer(get("/api/picture?id=0:1")).body, "a picture");
  EXPECT_EQ(served.answer(get("/api/points")).status, 404);
  query::putFile(folder_ / "points.ply", "ply and points");
  EXPECT_EQ(served.answer(get("/api/points?solid=1")).file, folder_ / "points.ply");
}

TEST_F(MapSiteTest, PagesAreToldWhenTheFilesOfTheViewInThreeDimensionsChange) {
  auto served = site();
  std::string warning;
  const auto solid = [&] { return json::parse(served.answer(get("/api/map")).body)["solid"]; };
  EXPECT_EQ(solid(), nullptr) << "there are none";
  query::putFile(folder_ / "landmarks.ply", "ply");
  EXPECT_NE(served.update(warning), "");
  const auto first = solid();
  ASSERT_TRUE(first.is_string());
  EXPECT_EQ(served.answer(change("/api/label", {"name", "0:2", "bed 1"})).status, 200);
  EXPECT_EQ(solid(), first) << "a name changes no file of them";
  query::putFile(folder_ / "landmarks.ply", "ply, and more");
  EXPECT_NE(served.update(warning), "");
  EXPECT_NE(solid(), first);
}

TEST_F(MapSiteTest, NoPathFromOutsideBecomesAFileName) {
  auto served = site();
  for (const char* target :
       {"/secret.txt", "/../map.omnimap", "/%2e%2e/map.omnimap", "/page/index.html", "//index.html", "/api/picture",
        "/api/picture?id=secret", "/api/picture?id=../rooms", "/api/picture?id=0:2", "/api/picture?id=0-1", "/nothing"})
    EXPECT_EQ(served.answer(get(target)).status, 404) << target;
}

TEST_F(MapSiteTest, QuestionsAreAnsweredAsOnTheCommandLine) {
  auto served = site();
  const auto asked = [&](const std::string& question) { return answered(served, "/api/query?q=" + question); };
  const auto found = json::parse(asked("118").body);
  EXPECT_TRUE(found["is_found"]);
  EXPECT_EQ(found["answer"]["matches"][0]["id"], "0:0") << found.dump(1);
  EXPECT_EQ(found.dump().find(folder_.path()), std::string::npos) << "paths of this machine are not for pages";
  EXPECT_EQ(json::parse(asked("path+kitchen+to+118").body)["answer"]["verb"], "path");
  EXPECT_FALSE(json::parse(asked("nothing+like+this").body)["is_found"]);
  EXPECT_EQ(asked("").status, 400);
  EXPECT_EQ(asked("near+1").status, 400);
  EXPECT_EQ(asked("%FF%FE").status, 400) << "no UTF-8";
}

TEST_F(MapSiteTest, ARoomIsRenamedInFilesAndMapAndAllPagesAreTold) {
  auto served = site();
  std::string warning;
  EXPECT_EQ(served.update(warning), "");
  const auto done = served.answer(edit({"rename", "room 1", "caf\xC3\xA9 <b>"}));
  EXPECT_EQ(done.status, 200) << done.body;
  EXPECT_EQ(json::parse(served.answer(get("/api/map")).body)["rooms"][0]["name"], "caf\xC3\xA9 <b>");
  EXPECT_EQ(json::parse(served.update(warning))["revision"], 2);
  EXPECT_EQ(served.update(warning), "");
  EXPECT_EQ(query::openMap(folder_.path()).rooms->rooms[0].name, "caf\xC3\xA9 <b>");
  EXPECT_TRUE(std::filesystem::exists(folder_ / "edits.json"));
}

TEST_F(MapSiteTest, AThingIsNamedAndAllPagesAreTold) {
  auto served = site();
  std::string warning;
  const auto label = [&](const json& words) { return served.answer(change("/api/label", words)); };
  EXPECT_EQ(json::parse(label({"name", "0:2", "Anna's bed"}).body)["done"], "it is called 'Anna's bed' now");
  EXPECT_EQ(json::parse(served.update(warning))["revision"], 2);
  EXPECT_EQ(json::parse(served.answer(get("/api/map")).body)["places"][2]["properties"]["name"], "Anna's bed");
  EXPECT_TRUE(json::parse(answered(served, "/api/query?q=path+kitchen+to+Anna's+bed").body)["is_found"]);
  EXPECT_EQ(label({"undo"}).status, 200);
  EXPECT_EQ(label({"undo"}).status, 400);
  HttpRequest of_a_stranger = change("/api/label", {"name", "0:2", "mine"});
  of_a_stranger.cookie.clear();
  EXPECT_EQ(served.answer(of_a_stranger).status, 401);
}

TEST_F(MapSiteTest, AThingIsDeletedAndRestored) {
  auto served = site();
  const auto correct = [&](const json& words) { return served.answer(change("/api/correct", words)); };
  const auto map = [&] { return json::parse(served.answer(get("/api/map")).body); };
  EXPECT_EQ(json::parse(correct({"delete", "0:2"}).body)["done"], "bed 0:2 is deleted");
  EXPECT_EQ(map()["places"].size(), 5U);
  EXPECT_EQ(map()["deleted"][0]["id"], "0:2");
  EXPECT_EQ(map()["deleted"][0]["who"], "page");
  EXPECT_EQ(correct({"restore", "0:2"}).status, 200);
  EXPECT_EQ(map()["places"].size(), 6U);
  EXPECT_EQ(correct({"restore", "0:2"}).status, 400);
  HttpRequest of_a_stranger = change("/api/correct", {"delete", "0:2"});
  of_a_stranger.cookie.clear();
  EXPECT_EQ(served.answer(of_a_stranger).status, 401);
}

TEST_F(MapSiteTest, AMapThatGrowsIsServedInPlaceOfTheOldOneAndIsNotChanged) {
  const std::string growing = folder_ / "growing";
  const auto serve = [&] {
    return MapSite(ServedMap(folder_ / "run", growing), StaticFiles(folder_ / "page"), Access({"map:8080"}, kToken),
                   [] { return base::stampFromUnix(1700000000); });
  };
  auto served = serve();
  std::string warning;
  const auto map = [&] { return json::parse(served.answer(get("/api/map")).body); };
  EXPECT_TRUE(map()["is_growing"]);
  EXPECT_TRUE(map()["places"].empty()) << "there is no map yet";
  EXPECT_FALSE(json::parse(answered(served, "/api/query?q=kitchen").body)["is_found"]);
  std::filesystem::create_directories(growing);
  std::filesystem::copy_file(map_.file, growing + "/checkpoint.omnimap");
  EXPECT_EQ(json::parse(served.update(warning))["revision"], 2);
  EXPECT_EQ(map()["places"].size(), 6U);
  for (const char* address : {"/api/edit", "/api/label", "/api/correct"}) {
    const auto refused = served.answer(change(address, {"delete", "0:2"}));
    EXPECT_EQ(refused.status, 400) << address;
    EXPECT_NE(refused.body.find("has not ended"), std::string::npos) << refused.body;
  }
  std::filesystem::create_directories(folder_ / "run");
  std::filesystem::copy_file(map_.file, folder_ / "run/map.omnimap");
  std::filesystem::remove_all(growing);
  EXPECT_NE(served.update(warning), "");
  EXPECT_FALSE(map()["is_growing"]);
  EXPECT_EQ(served.answer(change("/api/correct", {"delete", "0:2"})).status, 200);
}

// The run that goes on will replace the map of before, so a change of that would be lost.
TEST_F(MapSiteTest, TheMapOfBeforeIsNotServedBetweenTheStartOfARunAndItsFirstMap) {
  const std::string growing = folder_ / "growing", file = folder_ / "run/map.omnimap";
  std::filesystem::create_directories(folder_ / "run");
  std::filesystem::create_directories(growing);
  query::putFile(file, "a map that cannot be read stops no run");
  MapSite served(ServedMap(folder_ / "run", growing), StaticFiles(folder_ / "page"), Access({"map:8080"}, kToken),
                 [] { return base::stampFromUnix(1700000000); });
  std::string warning;
  const auto map = [&] { return json::parse(served.answer(get("/api/map")).body); };
  std::filesystem::copy_file(map_.file, file, std::filesystem::copy_options::overwrite_existing);
  served.update(warning);
  EXPECT_TRUE(map()["is_growing"]);
  EXPECT_TRUE(map()["places"].empty());
  for (const char* address : {"/api/edit", "/api/label", "/api/correct"})
    EXPECT_EQ(served.answer(change(address, {"delete", "0:2"})).status, 400) << address;
  std::filesystem::remove(growing);  // the run ended without a map of its own
  EXPECT_NE(served.update(warning), "");
  EXPECT_FALSE(map()["is_growing"]);
  EXPECT_EQ(map()["places"].size(), 6U);
}

TEST_F(MapSiteTest, WhatTheRunSaysAboutItselfHasNoNamesOfFiles) {
  EXPECT_EQ(json::parse(site().answer(get("/api/about")).body), json::object());
  query::putFile(folder_ / "summary.json",
                 R"({"title": "home", "verdict": {"sentence": "good"}, "warnings": ["/srv/x.ini: odd"],
                     "live": {"sensors": [{"name": "laser"}], "recording": {"files": ["/data"]}}})");
  const auto about = json::parse(site().answer(get("/api/about")).body);
  EXPECT_EQ(about, (json{{"title", "home"}, {"verdict", {{"sentence", "good"}}}, {"sensors", {{{"name", "laser"}}}}}));
  query::putFile(folder_ / "summary.json", "no JSON");
  EXPECT_EQ(json::parse(site().answer(get("/api/about")).body), json::object());
}

TEST_F(MapSiteTest, AfterTheClockWasSetBackTheRunIsNotGivenWhatItWouldReject) {
  double now = 1700000000;
  const std::string file = folder_ / "commands.csv";
  MapSite served(
      ServedMap(folder_.path()), StaticFiles(folder_ / "page"), Access({"map:8080"}, kToken),
      [&] { return base::stampFromUnix(now); }, RunCommands(file));
  const auto go = [&] {
    const auto ticket = json::parse(served.answer(change("/api/ticket", json::array())).body)["ticket"];
    return served.answer(change("/api/go", {"kitchen", ticket}));
  };
  EXPECT_EQ(go().status, 200);
  now -= 4;
  EXPECT_EQ(go().status, 200) << "the driver takes it";
  now -= 3600;
  const auto refused = go();
  EXPECT_EQ(refused.status, 400);
  EXPECT_NE(refused.body.find("the clock of this machine was set back"), std::string::npos) << refused.body;
  EXPECT_EQ(served.answer(change("/api/stop", json::array())).status, 200) << "a stop is always given";
  EXPECT_EQ(base::CsvTable(file).size(), 3U);
}

TEST_F(MapSiteTest, ALiveRunIsToldWhereToGoOnceAndToStopAtOnce) {
  EXPECT_EQ(site().answer(change("/api/stop", json::array())).status, 404) << "no run takes commands";
  double now = 1700000000;
  const std::string file = folder_ / "commands.csv";
  MapSite served(
      ServedMap(folder_.path()), StaticFiles(folder_ / "page"), Access({"map:8080"}, kToken),
      [&] { return base::stampFromUnix(now); }, RunCommands(file));
  const auto ticket = [&] {
    return json::parse(served.answer(change("/api/ticket", json::array())).body)["ticket"].get<std::string>();
  };
  const auto go = [&](const json& words) { return served.answer(change("/api/go", words)).status; };
  const std::string first = ticket();
  EXPECT_EQ(go({"a table, \"red\"", first}), 200);
  EXPECT_EQ(go({"kitchen", first}), 400) << "a ticket is used once";
  const std::string late = ticket();
  now += 61;
  EXPECT_EQ(go({"kitchen", late}), 400) << "a ticket is valid for a minute";
  EXPECT_EQ(go({"kitchen", "guessed"}), 400);
  EXPECT_EQ(go({"kitchen"}), 400);
  EXPECT_EQ(go({"", ticket()}), 400);
  EXPECT_EQ(served.answer(change("/api/stop", json::array())).status, 200);
  HttpRequest of_a_stranger = change("/api/stop", json::array());
  of_a_stranger.cookie.clear();
  EXPECT_EQ(served.answer(of_a_stranger).status, 401);

  const base::CsvTable table(file);
  ASSERT_EQ(table.size(), 2U);
  const auto goal = obs::commandIn(table, 0), stop = obs::commandIn(table, 1);
  EXPECT_EQ(goal.kind, obs::CommandKind::go_to);
  EXPECT_EQ(goal.text, "a table, \"red\"");
  EXPECT_EQ(goal.origin, "page");
  EXPECT_EQ(goal.expiry, RunCommands::kDriveExpiry);
  EXPECT_EQ(goal.timestamp, base::stampFromUnix(1700000000));
  EXPECT_EQ(stop.kind, obs::CommandKind::stop);
}

TEST_F(MapSiteTest, OnlyThePageOfTheUserPassesTheRateWithStop) {
  const MapSite served(
      ServedMap(folder_.path()), StaticFiles(folder_ / "page"), Access({"map:8080"}, kToken),
      [] { return base::stampFromUnix(1700000000); }, RunCommands(folder_ / "commands.csv"));
  const HttpRequest stop = change("/api/stop", json::array());
  EXPECT_TRUE(served.isStop(stop));
  EXPECT_FALSE(site().isStop(stop)) << "no run takes commands";
  HttpRequest other = stop;
  other.cookie.clear();
  EXPECT_FALSE(served.isStop(other)) << "without the token";
  other = stop;
  other.method = "GET";
  EXPECT_FALSE(served.isStop(other));
  EXPECT_FALSE(served.isStop(change("/api/go", json::array())));
}

TEST_F(MapSiteTest, NamesForASavedMapAreNoCommandsHoweverItIsCalled) {
  std::filesystem::copy_file(map_.file, folder_ / "home.omnimap");
  const std::string file = folder_ / "commands.csv";
  for (const auto& path : {folder_.path() + "//map.omnimap", folder_ / "home.omnimap"}) {
    MapSite served(
        ServedMap(path), StaticFiles(folder_ / "page"), Access({"map:8080"}, kToken),
        [] { return base::stampFromUnix(1700000000); }, RunCommands(file));
    EXPECT_EQ(served.answer(change("/api/label", {"name", "0:2", "bed 1"})).status, 200);
    EXPECT_EQ(json::parse(served.answer(get("/api/map")).body)["places"][2]["properties"]["name"], "bed 1") << path;
  }
  EXPECT_FALSE(std::filesystem::exists(file));
}

TEST_F(MapSiteTest, NamesForAMapThatIsStillMadeAreCommands) {
  std::filesystem::rename(map_.file, folder_ / "checkpoint.omnimap");
  const std::string file = folder_ / "commands.csv";
  MapSite served(
      ServedMap(folder_.path()), StaticFiles(folder_ / "page"), Access({"map:8080"}, kToken),
      [] { return base::stampFromUnix(1700000000); }, RunCommands(file));
  for (const auto& words : {json{"name", "0:2", "bed"}, json{"rename", "bed", "couch"}, json{"delete", "couch"}})
    EXPECT_EQ(served.answer(change("/api/label", words)).status, 200) << words;
  for (const auto& words : {json{"name", "1", "2", "spot"}, json{"name", "bed", "x"}, json{"rename", "a = b", "c"},
                            json{"rename", "a =", "b"}, json{"delete", std::string(201, 'x')}})
    EXPECT_EQ(served.answer(change("/api/label", words)).status, 400) << words;
  const base::CsvTable table(file);
  ASSERT_EQ(table.size(), 3U);
  EXPECT_EQ(obs::commandIn(table, 0).text, "name 0:2 = bed");
  EXPECT_EQ(obs::commandIn(table, 1).text, "rename bed = couch");
  EXPECT_LT(obs::commandIn(table, 0).timestamp, obs::commandIn(table, 1).timestamp) << "no two have one stamp";
}

TEST_F(MapSiteTest, ALineThatWasCutOffSpoilsNoOther) {
  const std::string file = folder_ / "commands.csv";
  query::putFile(file, std::string(obs::kCommandColumns) + "\n170000");
  CommandFile commands(file);
  obs::CObservationCommand stop;
  stop.timestamp = base::stampFromUnix(1700000000);
  stop.kind = obs::CommandKind::stop;
  commands.append(stop);
  std::ifstream in(file);
  std::string line;
  std::getline(in, line);
  std::getline(in, line);
  EXPECT_EQ(line, "170000");
  std::getline(in, line);
  EXPECT_EQ(line, "1700000000.0000000,stop,,any,,0.000,0.0000,0.0000,0.0000");
  std::filesystem::create_symlink(file, folder_ / "link.csv");
  EXPECT_THROW(CommandFile(folder_ / "link.csv").append(stop), base::Error) << "a link is not followed";
}

TEST_F(MapSiteTest, StampsOfCommandsIncreaseAlsoWhenTheServerBeginsAgainWithAClockThatWasSetBack) {
  const std::string file = folder_ / "commands.csv";
  obs::CObservationCommand stop;
  stop.kind = obs::CommandKind::stop;
  for (const double now : {1700000000, 1699999000, 1699999500}) {
    stop.timestamp = base::stampFromUnix(now);
    CommandFile(file).append(stop);
  }
  const base::CsvTable table(file);
  ASSERT_EQ(table.size(), 3U);
  for (std::size_t i : {1U, 2U})
    EXPECT_EQ(obs::commandIn(table, i).timestamp, base::stampFromUnix(1700000000) + base::Duration(i));
}

TEST_F(MapSiteTest, ATableWithOtherColumnsIsNotAppendedTo) {
  const std::string file = folder_ / "commands.csv", bytes = "stamp_s,kind\n1700000000,stop\n";
  query::putFile(file, bytes);
  obs::CObservationCommand stop;
  stop.kind = obs::CommandKind::stop;
  stop.timestamp = base::stampFromUnix(1700000000);
  const std::string said = query::refusalOf([&] { CommandFile(file).append(stop); }, base::ExitCode::unwritable_output);
  EXPECT_NE(said.find("name a new file"), std::string::npos) << said;
  std::ifstream in(file);
  EXPECT_EQ(std::string(std::istreambuf_iterator<char>(in), {}), bytes);
}

TEST_F(MapSiteTest, WhatCannotBeReadIsNamedWithoutWhereItIs) {
  auto served = site();
  query::putFile(map_.file, "damaged");
  for (const auto& request : {change("/api/label", {"undo"}), edit({"rename", "room 1", "x"})}) {
    const auto refused = served.answer(request);
    EXPECT_EQ(refused.status, 400);
    EXPECT_NE(refused.body.find("map.omnimap: is no map file"), std::string::npos) << refused.body;
    EXPECT_EQ(refused.body.find(folder_.path()), std::string::npos) << refused.body;
  }
}

TEST_F(MapSiteTest, ChangesThatAreNoneChangeNothing) {
  auto served = site();
  for (const auto& words : {json{"rename", "room 9", "x"}, json{"rename", "room 1", ""}, json{"burn"}, json::array(),
                            json{"rename", 1, "x"}, json("rename")})
    EXPECT_EQ(served.answer(edit(words)).status, 400) << words;
  HttpRequest request = edit({"rename", "room 1", "x"});
  for (const char* body : {"", "{", "[]", "null", "{\"words\": {}}"}) {
    request.body = body;
    EXPECT_EQ(served.answer(request).status, 400) << body;
  }
  EXPECT_FALSE(std::filesystem::exists(folder_ / "edits.json"));
}

TEST_F(MapSiteTest, OthersMayNotChangeTheMap) {
  auto served = site();
  const HttpRequest good = edit({"rename", "room 1", "mine"});
  const auto refusedWith = [&](int status, void (*spoil)(HttpRequest&)) {
    HttpRequest request = good;
    spoil(request);
    EXPECT_EQ(served.answer(request).status, status);
  };
  refusedWith(421, [](HttpRequest& request) { request.host = "evil.example:8080"; });  // DNS rebinding
  refusedWith(403, [](HttpRequest& request) { request.origin = "http://evil.example"; });
  refusedWith(403, [](HttpRequest& request) { request.origin = ""; });
  refusedWith(403, [](HttpRequest& request) { request.origin = "null"; });
  refusedWith(415, [](HttpRequest& request) { request.content_type = "text/plain"; });  // what a form can send
  refusedWith(401, [](HttpRequest& request) { request.cookie = ""; });
  refusedWith(401, [](HttpRequest& request) { request.cookie = "omnimapper_token=0123456789abcdee"; });
  refusedWith(405, [](HttpRequest& request) { request.method = "DELETE"; });
  refusedWith(404, [](HttpRequest& request) { request.path = "/api/map"; });
  EXPECT_FALSE(std::filesystem::exists(folder_ / "edits.json"));
  HttpRequest elsewhere = get("/api/map");
  elsewhere.host = "evil.example:8080";
  EXPECT_EQ(served.answer(elsewhere).status, 421) << "nor read it";
}

TEST_F(MapSiteTest, TheTokenBecomesACookieThatNoScriptReads) {
  auto served = site();
  EXPECT_EQ(served.answer(get("/enter?token=wrong")).status, 401);
  EXPECT_EQ(served.answer(get("/enter")).status, 401);
  const auto entered = served.answer(get(std::string("/enter?token=") + kToken));
  EXPECT_EQ(entered.status, 303);
  std::string cookie;
  for (const auto& [name, value] : entered.fields)
    if (name == "Set-Cookie") cookie = value;
  EXPECT_EQ(cookie, std::string("omnimapper_token=") + kToken + "; HttpOnly; SameSite=Strict; Path=/");
  HttpRequest me = get("/api/me");
  EXPECT_FALSE(json::parse(served.answer(me).body)["may_change"]);
  me.cookie = std::string("omnimapper_token=") + kToken;
  EXPECT_TRUE(json::parse(served.answer(me).body)["may_change"]);
}

TEST_F(MapSiteTest, EveryAnswerForbidsFramesScriptsFromElsewhereAndGuessing) {
  auto served = site();
  HttpRequest elsewhere = get("/");
  elsewhere.host = "evil.example";
  for (const auto& response : {served.answer(get("/")), served.answer(get("/nothing")), served.answer(elsewhere)}) {
    std::string all;
    for (const auto& [name, value] : response.fields) all += name + ": " + value + "\n";
    for (const char* part : {"default-src 'none'", "frame-ancestors 'none'", "X-Content-Type-Options: nosniff",
                             "Referrer-Policy: no-referrer"})
      EXPECT_NE(all.find(part), std::string::npos) << part;
  }
}

TEST_F(MapSiteTest, AMapThatIsReplacedIsReadAgainAndADamagedOneIsNot) {
  auto served = site();
  std::string warning;
  map_.places.places.pop_back();
  map::MapFile file;
  file.set(map::layerToSection(map::Places::kLayer, map::LayerOf<map::Places>(map_.places)));
  file.write(map_.file);
  EXPECT_EQ(json::parse(served.update(warning))["revision"], 2);
  EXPECT_EQ(json::parse(served.answer(get("/api/map")).body)["places"].size(), 5U);
  EXPECT_EQ(warning, "");
  query::putFile(map_.file, "damaged");
  EXPECT_EQ(served.update(warning), "");
  EXPECT_NE(warning.find(map_.file), std::string::npos) << warning;
  EXPECT_EQ(json::parse(served.answer(get("/api/map")).body)["places"].size(), 5U);
  warning.clear();
  EXPECT_EQ(served.update(warning), "");
  EXPECT_EQ(warning, "") << "said once";
}

TEST(Access, TokensAreRandomAndCompared) {
  EXPECT_EQ(randomToken().size(), 32U);
  EXPECT_NE(randomToken(), randomToken());
  EXPECT_TRUE(areSame("abc", "abc") && !areSame("abc", "abd") && !areSame("abc", "ab") && !areSame("", "a"));
}

}  // namespace
}  // namespace omnimapper::server::map_site_test
