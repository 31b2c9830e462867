#include <omnimapper/base/Error.h>
#include <omnimapper/query/Verbs.h>

#include "Answers.h"

namespace omnimapper::query {

const std::vector<Verb>& verbs() {
  using Range = NumberOption::Range;
  static const std::vector<Verb> all{
      {"find",
       "where is what is called so; the word find may be left out",
       "TEXT",
       "what stands on it, its kind, or words of its properties",
       1,
       -1,
       {},
       answerFind},
      {"near",
       "what is nearest to a point, by the distance to its extent",
       "X Y",
       "the point, in the frame of the map [m]",
       2,
       2,
       {{"within", "how far it may be [m]; without this the five that are nearest", 1, Range::not_negative}},
       answerNear},
      {"goal",
       "a free pose before what is called so, facing it",
       "TEXT",
       "what to go to, as for find",
       1,
       -1,
       {{"from", "X Y where the way begins [m]; default: where the base was last", 2, Range::any},
        {"radius", "of the robot [m]; default 0.25", 1, Range::not_negative},
        {"distance", "before the target [m]; default 1", 1, Range::positive}},
       answerGoal},
      {"list",
       "all landmarks of a kind, or how many there are of each kind",
       "KIND",
       "such as sign or wall",
       0,
       -1,
       {},
       answerList}};
  return all;
}

void expectWords(const Verb& verb, const Request& request) {
  if (request.words.size() < static_cast<std::size_t>(verb.least_words))
    throw base::Error(base::ExitCode::command_line, "after MAP say what to " + verb.name + ": " + verb.words + ", " +
                                                        verb.words_help + "; see --help");
}

}  // namespace omnimapper::query
