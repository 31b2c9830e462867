// omnimapper-edit: corrects a saved map.
#include <mrpt/core/Clock.h>
#include <omnimapper/query/correctMap.h>

#include <iostream>
#include <string>
#include <vector>

#include "program/Program.h"

int main(int argc, char** argv) {
  using namespace omnimapper;
  std::string map;
  query::Correction correction;
  bool quiet = false;
  CLI::App app(
      "Corrects a saved map: deletes landmarks that are none, and forbids loop closures that are wrong. Later sessions "
      "of the\n"
      "map keep to it.\n"
      "Examples: omnimapper-edit out/map delete 0:12\n"
      "          omnimapper-edit out/map forbid 0:85 0:3",
      "omnimapper-edit");
  app.add_option("MAP", map, "folder of a map, or a map file")->type_name("")->required();
  app.add_option(
         "CORRECTION", correction.words,
         "delete ID or restore ID, a landmark as omnimapper-query shows it; forbid FROM TO or allow FROM TO, the "
         "key frames of a loop closure as omnimapper-query MAP loops shows them")
      ->type_name("")
      ->required();
  app.add_flag("-q,--quiet", quiet, "no summary");
  app.footer("Exit codes: doc/exit_codes.md. More: doc/corrections.md.");
  return program::run(app, argc, argv, [&] {
    correction.when = mrpt::Clock::now();
    const std::string done = query::correctMap(map, correction);
    if (!quiet) std::cout << done << "\n";
    return 0;
  });
}
