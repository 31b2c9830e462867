#include "OtherWords.h"

#include <algorithm>
#include <cctype>
#include <map>

namespace omnimapper::query {

namespace {

/// The classes of surfaces that maps have (surfaces::SurfaceClass), by what people call the things.
const std::map<std::string, std::string>& classes() {
  static const std::map<std::string, std::string> all{{"armchair", "seat"},       {"bench", "seat"},
                                                      {"chair", "seat"},          {"couch", "seat"},
                                                      {"settee", "seat"},         {"sofa", "seat"},
                                                      {"stool", "seat"},          {"desk", "table"},
                                                      {"tabletop", "table"},      {"worktop", "counter"},
                                                      {"countertop", "counter"},  {"sink", "counter"},
                                                      {"bookcase", "shelf"},      {"bookshelf", "shelf"},
                                                      {"rack", "shelf"},          {"closet", "cabinet"},
                                                      {"cupboard", "cabinet"},    {"wardrobe", "cabinet"},
                                                      {"drawer", "cabinet"},      {"dresser", "cabinet"},
                                                      {"bathtub", "appliance"},   {"fridge", "appliance"},
                                                      {"oven", "appliance"},      {"printer", "appliance"},
                                                      {"radiator", "appliance"},  {"refrigerator", "appliance"},
                                                      {"stove", "appliance"},     {"television", "appliance"},
                                                      {"toilet", "appliance"},    {"tv", "appliance"},
                                                      {"washbasin", "appliance"}, {"picture", "poster"}};
  return all;
}

bool endsWith(const std::string& text, const std::string& end) {
  return text.size() > end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

std::string withoutEnd(const std::string& text, std::size_t letters, const std::string& other = "") {
  return text.substr(0, text.size() - letters) + other;
}

// Singulars that the text may be the plural of.
std::vector<std::string> singularsOf(const std::string& text) {
  std::vector<std::string> singulars;
  if (endsWith(text, "ves")) singulars.push_back(withoutEnd(text, 3, "f"));
  if (endsWith(text, "ies")) singulars.push_back(withoutEnd(text, 3, "y"));
  for (const char* end : {"ses", "xes", "ches", "shes"})
    if (endsWith(text, end)) singulars.push_back(withoutEnd(text, 2));
  if (endsWith(text, "s") && !endsWith(text, "ss")) singulars.push_back(withoutEnd(text, 1));
  return singulars;
}

}  // namespace

std::vector<std::string> otherWordsFor(const std::string& text) {
  std::string lower;
  for (const char c : text) lower += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  std::vector<std::string> words = singularsOf(lower);
  std::vector<std::string> asked = words;
  asked.insert(asked.begin(), lower);
  for (const auto& word : asked)
    if (const auto found = classes().find(word); found != classes().end()) words.push_back(found->second);
  return words;
}

}  // namespace omnimapper::query
