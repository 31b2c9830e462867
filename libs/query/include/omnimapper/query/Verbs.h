#pragma once

#include <omnimapper/base/Error.h>
#include <omnimapper/query/MapToAsk.h>

#include <map>
#include <string>
#include <vector>

namespace omnimapper::query {

/// A query to a map.
struct Request {
  std::vector<std::string> words;                      ///< the words after the verb
  std::map<std::string, std::vector<double>> numbers;  ///< the numbers of each option that was given
  bool brief = false;                                  ///< the JSON has only names and positions of landmarks
  std::map<std::string, std::string> texts = {};       ///< the texts of options that were given
};

struct Answer {
  std::string text;                          ///< lines for a terminal; control characters in names are made printable
  std::string json;                          ///< the answer as one JSON document, ASCII
  base::ExitCode code = base::ExitCode::ok;  ///< ok or nothing_found
};

/// An option of a verb that takes numbers.
struct NumberOption {
  enum class Range { any, not_negative, positive };
  std::string name, help;
  int count = 1;  ///< number of values
  Range range = Range::any;
};

/// An option of a verb that takes a text.
struct TextOption {
  std::string name, help;
};

/// A kind of query. Programs build their command line from this table.
struct Verb {
  std::string name;   ///< "find"
  std::string help;   ///< one line
  std::string words;  ///< name of its words in the help: "TEXT"; empty if it takes none
  std::string words_help;
  int least_words = 0, most_words = 0;  ///< -1: any number
  std::vector<NumberOption> options;
  /// Throws base::Error for a query that is not valid or cannot be answered.
  Answer (*answer)(const MapToAsk& map, const Request& request);
  std::vector<TextOption> texts = {};
};

/// Throws Error(command_line) if the request has too few words for the verb.
void expectWords(const Verb& verb, const Request& request);

/// All verbs. If the words after the map on the command line contain no verb, the first verb is used.
const std::vector<Verb>& verbs();

}  // namespace omnimapper::query
