// omnimapper-export: writes a map for other programs and people.
#include <omnimapper/server/exportPage.h>

#include <iostream>
#include <string>

#include "program/Program.h"
#include "program/shippedFolder.h"

int main(int argc, char** argv) {
  using namespace omnimapper;
  std::string map, output;
  bool quiet = false;
  CLI::App app("Writes a map for other programs and people.", "omnimapper-export");
  CLI::App* page =
      app.add_subcommand("page", "a folder with the page of a map, which a browser opens without a server");
  page->add_option("MAP", map, "folder of a map, or a map file")->type_name("")->required();
  page->add_option("OUT", output, "folder for the page, created if missing")->type_name("")->required();
  page->add_flag("-q,--quiet", quiet, "print nothing but errors");
  app.require_subcommand(1);
  app.footer(
      "Example: omnimapper-export page out/map out/page\n"
      "Then open out/page/index.html, or copy the folder to a web server. Exit codes: doc/exit_codes.md. More: "
      "doc/page.md.");
  return program::run(app, argc, argv, [&] {
    server::exportPage(map, program::shippedFolder("web"), output);
    if (!quiet) std::cout << "The page is " << output << "/index.html\n";
    return 0;
  });
}
