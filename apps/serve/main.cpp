// omnimapper-serve: shows a map in a browser.
#include <mrpt/core/Clock.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/base/Names.h>
#include <omnimapper/server/HttpServer.h>
#include <omnimapper/server/MapSite.h>

#include <cstdint>
#include <iostream>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "program/Program.h"
#include "program/shippedFolder.h"

namespace {

using namespace omnimapper;

struct Arguments {
  std::string map, address = "127.0.0.1", commands;
  std::vector<std::string> hosts;
  std::uint16_t port = 8080;
  bool is_read_only = false, quiet = false;
};

void addOptions(CLI::App& app, Arguments& arguments) {
  app.description("Shows a map in a browser, also while it grows: rooms, landmarks and objects, with search.");
  app.add_option("MAP", arguments.map, "folder of a map or of a live run, or a map file")->type_name("")->required();
  app.add_option("--port", arguments.port, "port of this machine; 0 takes a free one; default 8080");
  app.add_option("--address", arguments.address,
                 "numeric address of this machine that is listened on; it must be a loopback address, for there is no "
                 "encryption");
  app.add_option("--host", arguments.hosts,
                 "further name under which the page is reached, with its port: that of a reverse proxy which encrypts");
  app.add_option("--commands", arguments.commands,
                 "table to which goals, stop and names for a live run are appended; the run reads it by the driver "
                 "CCommandFile");
  app.add_flag("--read-only", arguments.is_read_only, "the page cannot change the map");
  app.add_flag("-q,--quiet", arguments.quiet, "print nothing but errors");
  app.footer(
      "Example: omnimapper-serve out/map\n"
      "It prints the address of the page, and ends with Ctrl-C. Exit codes: doc/exit_codes.md. More: doc/page.md.");
}

void refuseOtherMachines(const std::string& address) {
  if (server::isLoopback(address)) return;
  throw base::Error(base::ExitCode::command_line,
                    "'" + base::printable(address) +
                        "' is no loopback address such as 127.0.0.1: other machines would reach the page, which is not "
                        "encrypted. A reverse proxy with TLS (--host NAME), or ssh -L 8080:127.0.0.1:8080, may lead "
                        "there; see doc/security.md");
}

int serve(const Arguments& arguments) {
  program::listenForInterrupts();
  program::nothingIsLeftToDo();
  refuseOtherMachines(arguments.address);
  const std::string token = server::randomToken();
  server::ServedMap map(arguments.map);
  server::StaticFiles files(program::shippedFolder("web"));
  server::MapSite* answering = nullptr;
  server::HttpServer http(
      arguments.address, arguments.port, {},
      [&](const server::HttpRequest& request) { return answering->answer(request); },
      [&](const server::HttpRequest& request) { return answering->isStop(request); });
  auto hosts = server::hostsAt(arguments.address, http.port());
  hosts.insert(hosts.end(), arguments.hosts.begin(), arguments.hosts.end());
  std::optional<server::RunCommands> commands;
  if (!arguments.commands.empty()) commands.emplace(arguments.commands);
  // Without the token, which then nobody is told, nothing can be changed.
  server::MapSite site(
      std::move(map), std::move(files), server::Access(hosts, token), [] { return mrpt::Clock::now(); },
      std::move(commands));
  answering = &site;
  const std::string start = arguments.is_read_only ? "/" : "/enter?token=" + token;
  if (!arguments.quiet)
    std::cout << "The map is at http://" << hosts.front() << start << "\nCtrl-C ends.\n" << std::flush;
  http.run(program::isInterrupted, [&] {
    std::string warning;
    if (const auto event = site.update(warning); !event.empty()) http.send(event);
    if (!warning.empty()) std::cerr << "omnimapper-serve: warning: " << base::printableLines(warning) << "\n";
  });
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  Arguments arguments;
  CLI::App app("", "omnimapper-serve");
  addOptions(app, arguments);
  return omnimapper::program::run(app, argc, argv, [&] { return serve(arguments); });
}
