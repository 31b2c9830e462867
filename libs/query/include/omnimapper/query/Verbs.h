#pragma once

#include <omnimapper/base/Error.h>
#include <omnimapper/query/MapToAsk.h>

#include <map>
#include <string>
#include <vector>

namespace omnimapper::query {

/// What is asked of a map.
struct Request {
  std::vector<std::string> words;                      ///< what stands after the verb
  std::map<std::string, std::vector<double>> numbers;  ///< by option: of those that were given
};

struct Answer {
  std::string text;                          ///< lines for a terminal: nothing of the map in it moves the cursor
  std::string json;                          ///< the same as one document, ASCII
  base::ExitCode code = base::ExitCode::ok;  ///< or nothing_found
};

/// An option of a verb that takes numbers.
struct NumberOption {
  enum class Range { any, not_negative, positive };
  std::string name, help;
  int count = 1;  ///< of numbers
  Range range = Range::any;
};

/// Something that a map can be asked. Programs make their command line of this table.
struct Verb {
  std::string name;   ///< "find"
  std::string help;   ///< one line
  std::string words;  ///< what its words are, for help: "TEXT"
  std::string words_help;
  int least_words = 0, most_words = 0;  ///< -1: any number
  std::vector<NumberOption> options;
  /// Throws base::Error for what cannot be asked or answered.
  Answer (*answer)(const MapToAsk& map, const Request& request);
};

/// Throws Error(command_line) if the request has too few words for the verb.
void expectWords(const Verb& verb, const Request& request);

/// All of them; the first is meant where words follow the map and none of them is a verb.
const std::vector<Verb>& verbs();

}  // namespace omnimapper::query
