#include <omnimapper/base/Error.h>
#include <omnimapper/base/Names.h>
#include <omnimapper/query/Verbs.h>
#include <omnimapper/query/correctMap.h>
#include <omnimapper/query/editLabels.h>
#include <omnimapper/query/editRooms.h>
#include <omnimapper/server/MapSite.h>

#include <cmath>
#include <exception>
#include <nlohmann/json.hpp>
#include <sstream>
#include <utility>
#include <vector>

namespace omnimapper::server {

using Json = nlohmann::ordered_json;

namespace {

constexpr char kJson[] = "application/json", kStop[] = "/api/stop";

std::string dumped(const Json& json) {
  return json.dump(-1, ' ', true, Json::error_handler_t::replace) + "\n";
}

HttpResponse jsonAnswer(const std::string& body) {
  return {200, kJson, body};
}

std::vector<std::string> wordsOf(const std::string& text) {
  std::vector<std::string> words;
  std::istringstream in(text);
  for (std::string word; in >> word;) words.push_back(word);
  return words;
}

/// The verb with which a question begins, which is taken from its words; `find` if it begins with none.
const query::Verb& verbOf(std::vector<std::string>& words) {
  for (const auto& verb : query::verbs()) {
    if (words.empty() || words.front() != verb.name) continue;
    words.erase(words.begin());
    return verb;
  }
  return query::verbs().front();
}

/// The change of a request: a JSON object with a list of texts, "words". Throws Error(command_line) if it is another
/// one.
std::vector<std::string> changeWords(const std::string& body) {
  const Json json = Json::parse(body, nullptr, false);
  if (json.is_object() && json.contains("words") && json["words"].is_array()) {
    std::vector<std::string> words;
    for (const auto& word : json["words"])
      if (word.is_string()) words.push_back(word.get<std::string>());
    if (words.size() == json["words"].size()) return words;
  }
  throw base::Error(base::ExitCode::command_line, "a change is a JSON object with a list of texts, \"words\"");
}

// Where the map is on this machine is nothing for a page, so names of files are those in the folder of the map.
HttpResponse refusedBecause(const base::Error& error, const query::MapToAsk& map) {
  std::string sentence = error.what();
  const std::string folder = map.folder + "/";
  for (auto at = sentence.find(folder); at != std::string::npos; at = sentence.find(folder, at))
    sentence.erase(at, folder.size());
  return refusal(error.code() == base::ExitCode::disk_full ? 507 : 400, base::printable(sentence));
}

HttpResponse defect(const std::exception& error) {
  return refusal(500, std::string("a defect of the server: ") + error.what());
}

HttpResponse answerQuestion(const query::MapToAsk& map, const std::string& text) {
  try {
    query::Request asked;
    asked.words = wordsOf(text);
    const auto& verb = verbOf(asked.words);
    query::expectWords(verb, asked);
    const query::Answer answer = verb.answer(map, asked);
    Json document = Json::parse(answer.json, nullptr, false);
    document.erase("map");  // the path of a file on this machine is nothing for a page
    return jsonAnswer(dumped(
        {{"is_found", answer.code == base::ExitCode::ok}, {"text", answer.text}, {"answer", std::move(document)}}));
  } catch (const base::Error& error) {
    return refusedBecause(error, map);
  } catch (const std::exception& error) {
    return defect(error);
  }
}

}  // namespace

MapSite::MapSite(ServedMap map, StaticFiles files, Access access, std::function<base::Stamp()> clock,
                 std::optional<RunCommands> commands)
    : map_(std::move(map)),
      files_(std::move(files)),
      access_(std::move(access)),
      clock_(std::move(clock)),
      commands_(std::move(commands)),
      announced_(map_.revision()) {}

HttpResponse MapSite::answer(const HttpRequest& request) {
  HttpResponse response;
  try {
    const auto refused = access_.refused(request);
    response = refused ? *refused : answerAllowed(request);
  } catch (const base::Error& error) {
    response = refusedBecause(error, map_.map());
  } catch (const std::exception& error) {
    response = defect(error);
  }
  Access::protect(response);
  return response;
}

bool MapSite::isStop(const HttpRequest& request) const {
  return commands_ && request.method == "POST" && request.path == kStop && !access_.refused(request);
}

HttpResponse MapSite::answerAllowed(const HttpRequest& request) {
  if (request.method == "POST") return change(request);
  if (const auto file = files_.find(request.path)) return *file;
  if (request.path == "/enter") return access_.enter(request);
  if (request.path == "/api/map") return jsonAnswer(map_.document());
  if (request.path == "/api/about") return jsonAnswer(map_.about());
  if (request.path == "/api/trajectory") return jsonAnswer(map_.trajectory());
  if (request.path == "/api/query") return question(request);
  if (request.path == "/api/picture") return picture(request);
  if (request.path == "/api/points") return ply("points.ply");
  if (request.path == "/api/surfaces") return ply("landmarks.ply");
  if (request.path == "/api/events") return events();
  if (request.path == "/api/me") return me(request);
  if (request.path == "/api/grid" && !map_.gridPng().empty()) return {200, "image/png", map_.gridPng()};
  return refusal(404, "There is nothing at this address.");
}

// A path in a large grid takes long, so another thread answers, which reads this map only.
HttpResponse MapSite::question(const HttpRequest& request) const {
  const auto text = request.values.find("q");
  if (text == request.values.end() || text->second.empty())
    return refusal(400, "A question is missing: /api/query?q=kitchen");
  HttpResponse response;
  response.later = [map = map_.sharedMap(), asked = text->second] {
    HttpResponse answer = answerQuestion(*map, asked);
    Access::protect(answer);
    return answer;
  };
  return response;
}

HttpResponse MapSite::ply(const std::string& name) const {
  const auto file = map_.fileOfRun(name);
  if (!file) return refusal(404, "The map has no such file, or it is too large for a page.");
  HttpResponse response{200, "application/octet-stream", ""};
  response.file = *file;
  return response;
}

HttpResponse MapSite::me(const HttpRequest& request) const {
  const bool may_change = access_.mayChange(request);
  return jsonAnswer(dumped({{"may_change", may_change}, {"may_drive", may_change && commands_}}));
}

HttpResponse MapSite::picture(const HttpRequest& request) const {
  const auto id = request.values.find("id");
  const auto bytes = id == request.values.end() ? std::nullopt : map_.pictureOf(id->second);
  if (!bytes) return refusal(404, "There is no picture of it.");
  return {200, "image/png", *bytes};
}

// What people change is in the files of a map, which a run that goes on would write over.
void MapSite::expectWhole() const {
  if (isGrowing(map_.map()))
    throw base::Error(base::ExitCode::unreadable_input,
                      "the run that makes this map has not ended; that can be changed when it has");
}

std::string MapSite::editRooms(const std::vector<std::string>& words) {
  expectWhole();
  return query::editRooms(map_.map().folder, words);
}

std::string MapSite::editLabels(const std::vector<std::string>& words) {
  if (!commands_) expectWhole();
  if (!isGrowing(map_.map())) return query::editLabels(map_.map().file, {words, "page", clock_()}, labels_);
  commands_->label(words, clock_());
  return "the run was told; the name is in the map with its next checkpoint";
}

std::string MapSite::correct(const std::vector<std::string>& words) {
  expectWhole();
  return query::correctMap(map_.map().file, {words, "page", clock_()});
}

std::string MapSite::goTo(const std::vector<std::string>& words) {
  if (words.size() != 2) throw base::Error(base::ExitCode::command_line, "going needs a goal and a ticket");
  commands_->goTo(words[0], words[1], clock_());
  return "the run was told to go to '" + words[0] + "'";
}

std::string MapSite::stop() {
  commands_->stop(clock_());
  return "the run was told to stop";
}

HttpResponse MapSite::ticket() {
  return jsonAnswer(dumped({{"ticket", commands_->ticket(clock_())}}));
}

HttpResponse MapSite::change(const HttpRequest& request) {
  std::string done, warning;
  if (request.path == "/api/edit")
    done = editRooms(changeWords(request.body));
  else if (request.path == "/api/label")
    done = editLabels(changeWords(request.body));
  else if (request.path == "/api/correct")
    done = correct(changeWords(request.body));
  else if (commands_ && request.path == "/api/ticket")
    return ticket();
  else if (commands_ && request.path == "/api/go")
    done = goTo(changeWords(request.body));
  else if (commands_ && request.path == kStop)
    done = stop();
  else
    return refusal(404, "Nothing at this address can be changed.");
  map_.update(warning);
  return jsonAnswer(dumped({{"done", done}}));
}

std::string MapSite::revisionEvent() const {
  return Json{{"revision", map_.revision()}}.dump();
}

HttpResponse MapSite::events() const {
  HttpResponse response{200, "text/event-stream", "data: " + revisionEvent() + "\n\n"};
  response.is_event_stream = true;
  return response;
}

std::string MapSite::update(std::string& warning) {
  map_.update(warning);
  if (map_.revision() == announced_) return {};
  announced_ = map_.revision();
  return revisionEvent();
}

}  // namespace omnimapper::server
