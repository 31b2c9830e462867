#pragma once

#include <string>
#include <vector>

namespace omnimapper::mapper {

/// One figure of a finished map that says whether it can be trusted, as a plugin found it.
struct Evidence {
  enum class Says {
    good,        ///< nothing against the map
    too_little,  ///< what would show an error is not there
    against_it,  ///< a consistent map would not have it
  };
  std::string name;  ///< key in summary.json, ending in its unit
  double value = 0;
  Says says = Says::good;
  std::string reason;  ///< half a sentence that says what, where and when; empty if nothing is to be said
};

/// What a run thinks of its own map.
struct Verdict {
  enum class Answer { consistent, cannot_tell, suspicious };
  Answer answer = Answer::cannot_tell;
  std::vector<Evidence> evidence;
};

/// Suspicious if any evidence is against the map, else "cannot tell" if there is too little of some, or none at all.
/// Where one plugin knows too little and another tells more under the same name, the other counts.
Verdict conclude(std::vector<Evidence> all);

/// "consistent", "cannot tell" or "suspicious".
std::string toString(Verdict::Answer answer);
/// The whole verdict in one sentence, with the reasons behind it.
std::string sentenceOf(const Verdict& verdict);

}  // namespace omnimapper::mapper
