#pragma once

#include <omnimapper/server/Access.h>
#include <omnimapper/server/HttpMessage.h>
#include <omnimapper/server/ServedMap.h>
#include <omnimapper/server/StaticFiles.h>

#include <string>

namespace omnimapper::server {

/// The page of a map and what it asks for (doc/page.md lists the addresses).
class MapSite {
 public:
  MapSite(ServedMap map, StaticFiles files, Access access);

  /// Answers any request; never throws.
  HttpResponse answer(const HttpRequest& request);

  /// Reads the map again if it changed. The event for the pages, or empty if there is nothing new. `warning` is for the
  /// terminal.
  std::string update(std::string& warning);

 private:
  HttpResponse answerAllowed(const HttpRequest& request);
  HttpResponse question(const HttpRequest& request) const;
  HttpResponse picture(const HttpRequest& request) const;
  HttpResponse edit(const HttpRequest& request);
  HttpResponse events() const;
  std::string revisionEvent() const;

  ServedMap map_;
  StaticFiles files_;
  Access access_;
  int announced_;  // revision of the last event
};

}  // namespace omnimapper::server
