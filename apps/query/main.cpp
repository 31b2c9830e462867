// omnimapper-query: queries a map by names.
#include <omnimapper/base/Error.h>
#include <omnimapper/base/Names.h>
#include <omnimapper/query/Verbs.h>

#include <algorithm>
#include <cmath>
#include <iostream>

#include "program/Program.h"

namespace {

using namespace omnimapper;
struct Arguments {
  bool json = false, brief = false;
  std::string map;
  std::vector<std::string> words;                  // the words if no verb was given
  std::map<std::string, query::Request> requests;  // by verb
};

CLI::Validator finite() {
  return CLI::Validator(
      [](const std::string& text) {
        double value = 0;
        const bool is_number = CLI::detail::lexical_cast(text, value) && std::isfinite(value);
        return is_number ? std::string() : "'" + text + "' is not a finite number";
      },
      "");
}

CLI::Validator validatorOf(query::NumberOption::Range range) {
  using Range = query::NumberOption::Range;
  return range == Range::any ? finite() : range == Range::positive ? program::positive() : program::notNegative();
}

void addVerb(CLI::App& app, const query::Verb& verb, query::Request& request, Arguments& arguments) {
  CLI::App* added = app.add_subcommand(verb.name, verb.help);
  if (!verb.words.empty())
    added->add_option(verb.words, request.words, verb.words_help)->type_name("")->expected(0, verb.most_words);
  for (const auto& option : verb.options)
    added->add_option("--" + option.name, request.numbers[option.name], option.help)
        ->expected(option.count)
        ->check(validatorOf(option.range));
  for (const auto& option : verb.texts)
    added->add_option("--" + option.name, request.texts[option.name], option.help)->type_name("TEXT");
  added->add_flag("--json", arguments.json, "print one JSON document");
  added->add_flag("--brief", arguments.brief, "with --json: only names and positions of landmarks");
}

void addOptions(CLI::App& app, Arguments& arguments) {
  app.description("Queries a map: where a landmark is, what is near a point, a free pose in front of a landmark.");
  app.add_option("MAP", arguments.map, "folder of a map, or its map.omnimap")->type_name("")->required();
  app.add_option("TEXT", arguments.words, "name to find, if no verb is given")->type_name("")->expected(1, -1);
  app.add_flag("--json", arguments.json, "print one JSON document");
  app.add_flag("--brief", arguments.brief, "with --json: only names and positions of landmarks");
  app.require_subcommand(0, 1);
  for (const auto& verb : query::verbs()) addVerb(app, verb, arguments.requests[verb.name], arguments);
  app.footer(
      "Examples:\n"
      "  omnimapper-query out/map 213                        where the sign 213 is\n"
      "  omnimapper-query out/map goal kitchen --from 0 0    a free pose in front of it, facing it\n"
      "  omnimapper-query out/map path here to 213           the way there, with its rooms and doors\n"
      "Options of a verb: omnimapper-query MAP goal --help. A text that is a verb: omnimapper-query MAP find list.\n"
      "Exit codes: doc/exit_codes.md (20: the map has no answer). More: doc/query.md.");
}

int answer(const CLI::App& app, const Arguments& arguments) {
  const auto parsed = app.get_subcommands();
  const query::Verb* asked = &query::verbs().front();
  for (const auto& verb : query::verbs())
    if (!parsed.empty() && verb.name == parsed.front()->get_name()) asked = &verb;
  query::Request request = arguments.requests.at(asked->name);
  if (parsed.empty()) request.words = arguments.words;
  request.brief = arguments.brief;
  if (!parsed.empty() && !arguments.words.empty())
    throw base::Error(base::ExitCode::command_line, "'" + base::printable(arguments.words.front().substr(0, 40)) +
                                                        "' is given before the verb " + asked->name +
                                                        ": after the map give a text or a verb");
  query::expectWords(*asked, request);
  const query::Answer answer = asked->answer(query::openMap(arguments.map), request);
  if (arguments.json) {
    std::cout << answer.json;
  } else {
    (answer.code == base::ExitCode::ok ? std::cout : std::cerr << app.get_name() << ": ") << answer.text;
  }
  if (!std::cout.flush())
    throw base::Error(base::ExitCode::disk_full, "the answer cannot be written to standard output; is the disk full?");
  return static_cast<int>(answer.code);
}

}  // namespace

int main(int argc, char** argv) {
  Arguments arguments;
  CLI::App app("", "omnimapper-query");
  addOptions(app, arguments);
  return omnimapper::program::run(app, argc, argv, [&] { return answer(app, arguments); });
}
