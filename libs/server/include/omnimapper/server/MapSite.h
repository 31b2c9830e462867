#pragma once

#include <omnimapper/base/Error.h>
#include <omnimapper/base/Stamp.h>
#include <omnimapper/map/LabelEdits.h>
#include <omnimapper/server/Access.h>
#include <omnimapper/server/HttpMessage.h>
#include <omnimapper/server/RunCommands.h>
#include <omnimapper/server/ServedMap.h>
#include <omnimapper/server/StaticFiles.h>

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace omnimapper::server {

/// The page of a map and what it asks for (doc/page.md lists the addresses).
class MapSite {
 public:
  /// `clock` says when a change is asked for. `commands` are for the live run that makes the map; without them the page
  /// offers none.
  MapSite(ServedMap map, StaticFiles files, Access access, std::function<base::Stamp()> clock,
          std::optional<RunCommands> commands = {});

  /// Answers any request; never throws. The answer to a question is HttpResponse::later.
  HttpResponse answer(const HttpRequest& request);

  /// Whether the request stops the robot of a live run, and may do so.
  bool isStop(const HttpRequest& request) const;

  /// Reads the map again if it changed. The event for the pages, or empty if there is nothing new. `warning` is for the
  /// terminal.
  std::string update(std::string& warning);

 private:
  HttpResponse answerAllowed(const HttpRequest& request);
  HttpResponse question(const HttpRequest& request) const;
  HttpResponse ply(const std::string& name) const;
  HttpResponse me(const HttpRequest& request) const;
  HttpResponse picture(const HttpRequest& request) const;
  /// Rooms, labels, corrections, or commands for a live run.
  HttpResponse change(const HttpRequest& request);
  void expectWhole() const;
  std::string editRooms(const std::vector<std::string>& words);
  std::string editLabels(const std::vector<std::string>& words);
  std::string correct(const std::vector<std::string>& words);
  std::string goTo(const std::vector<std::string>& words);
  std::string stop();
  HttpResponse ticket();
  HttpResponse events() const;
  std::string revisionEvent() const;

  ServedMap map_;
  StaticFiles files_;
  Access access_;
  std::function<base::Stamp()> clock_;
  std::optional<RunCommands> commands_;
  map::LabelEdits labels_;  // of this map, for undo
  int announced_;           // revision of the last event
};

}  // namespace omnimapper::server
