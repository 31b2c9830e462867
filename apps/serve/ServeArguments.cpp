#include "ServeArguments.h"

#include <omnimapper/base/Error.h>
#include <omnimapper/base/Names.h>
#include <omnimapper/server/HttpServer.h>

using namespace omnimapper;

void addOptions(CLI::App& app, ServeArguments& arguments) {
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
  app.add_option("--growing", arguments.growing,
                 "folder of a map that a run writes while it goes on; while it has one, that is shown in place of MAP, "
                 "which need not exist yet");
  app.add_flag("--until-end-of-input", arguments.until_end_of_input,
               "end when the standard input ends, as when a program that started this one ends");
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
