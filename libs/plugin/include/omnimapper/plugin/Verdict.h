#pragma once

#include <string>
#include <vector>

namespace omnimapper::mapper {

/// One number that a plugin computed from a finished map, and whether this number is for or against the map.
struct Evidence {
  enum class Says {
    good,        ///< it is not against the map
    too_little,  ///< there is too little data to show an error
    against_it,  ///< a consistent map would not have this value
  };
  std::string name;  ///< key in summary.json, ending in its unit
  double value = 0;
  Says says = Says::good;
  std::string reason;  ///< part of a sentence: what, where and when; empty if there is nothing to report
};

/// The judgement of a run on its own map.
struct Verdict {
  enum class Answer { consistent, cannot_tell, suspicious };
  Answer answer = Answer::cannot_tell;
  std::vector<Evidence> evidence;
};

/// Suspicious if any evidence is against the map; else "cannot tell" if any evidence is too_little or there is no
/// evidence at all; else consistent. Evidence that is too_little is ignored if other evidence of the same name is not
/// too_little.
Verdict conclude(std::vector<Evidence> all);

/// "consistent", "cannot tell" or "suspicious".
std::string toString(Verdict::Answer answer);
/// The whole verdict in one sentence, with the reasons behind it.
std::string sentenceOf(const Verdict& verdict);

}  // namespace omnimapper::mapper
