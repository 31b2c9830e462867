// omnimapper-serve: shows a map in a browser.
#include <mrpt/core/Clock.h>
#include <omnimapper/base/Names.h>
#include <omnimapper/server/HttpServer.h>
#include <omnimapper/server/MapSite.h>
#include <poll.h>
#include <unistd.h>

#include <iostream>
#include <optional>
#include <string>
#include <utility>

#include "ServeArguments.h"
#include "program/Program.h"
#include "program/shippedFolder.h"

namespace {

using namespace omnimapper;

bool inputHasEnded() {
  pollfd input{STDIN_FILENO, POLLIN, 0};
  char ignored = 0;
  return ::poll(&input, 1, 0) > 0 && ::read(STDIN_FILENO, &ignored, 1) <= 0;
}

int serve(const ServeArguments& arguments) {
  program::listenForInterrupts();
  program::nothingIsLeftToDo();
  refuseOtherMachines(arguments.address);
  const std::string token = server::randomToken();
  server::ServedMap map(arguments.map, arguments.growing);
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
    std::cout << "The map is at http://" << hosts.front() << start << "\n"
              << (arguments.until_end_of_input ? "" : "Ctrl-C ends.\n") << std::flush;
  const auto stop = [&] { return program::isInterrupted() || (arguments.until_end_of_input && inputHasEnded()); };
  http.run(stop, [&] {
    std::string warning;
    if (const auto event = site.update(warning); !event.empty()) http.send(event);
    if (!warning.empty()) std::cerr << "omnimapper-serve: warning: " << base::printableLines(warning) << "\n";
  });
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  ServeArguments arguments;
  CLI::App app("", "omnimapper-serve");
  addOptions(app, arguments);
  return omnimapper::program::run(app, argc, argv, [&] { return serve(arguments); });
}
