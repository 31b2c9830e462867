#include <omnimapper/base/Error.h>
#include <omnimapper/base/Names.h>
#include <omnimapper/query/Find.h>

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <limits>
#include <optional>
#include <tuple>

#include "Letters.h"
#include "OtherWords.h"

namespace omnimapper::query {

namespace {

constexpr std::size_t kLongestText = 200;  // largest number of characters
constexpr std::size_t kMostNames = 3;      // number of suggested names if nothing fits
constexpr double kFarFetched = 0.75;       // names with a larger cost are not suggested, ...
constexpr long kNextDoors = 10;            // ... unless they are numbers that differ by at most this

[[noreturn]] void refuseText(const std::string& reason) {
  throw base::Error(base::ExitCode::command_line, reason);
}

// Refuses a text without repeating one that would fill the screen.
void expectText(const std::string& text) {
  if (text.find_first_not_of(" \t") == std::string::npos)
    refuseText("the text to find is empty: give the text of a sign, or a kind such as wall");
  if (text.size() > 4 * kLongestText || charactersOf(text).size() > kLongestText)
    refuseText("the text to find has " + std::to_string(text.size()) + " bytes: at most " +
               std::to_string(kLongestText) + " characters are compared. Give a few words of it.");
  if (const std::string shown = base::printable(text); shown != text)
    refuseText("the text to find has control characters or is not UTF-8: '" + shown + "'. Give it without them.");
}

std::vector<std::string> partsOf(const std::string& list) {
  std::vector<std::string> parts;
  for (std::size_t begin = 0; begin <= list.size();) {
    const std::size_t end = std::min(list.find(", ", begin), list.size());
    if (end > begin) parts.push_back(list.substr(begin, end - begin));
    begin = end + 2;
  }
  return parts;
}

// A name that is the same as one of the other words for a text.
std::optional<TextMatch> asOtherWord(const std::vector<AskedText>& others, const std::vector<std::string>& names) {
  for (const auto& other : others) {
    const TextMatch match = bestOf(other, names);
    if (match.grade <= MatchGrade::same_letters) return TextMatch{MatchGrade::other_word, 0, match.name};
  }
  return std::nullopt;
}

bool isBefore(const FoundPlace& a, const FoundPlace& b) {
  if (a.match.grade != b.match.grade) return a.match.grade < b.match.grade;
  if (a.match.cost != b.match.cost) return a.match.cost < b.match.cost;
  if (a.match.name != b.match.name) return naturallyBefore(a.match.name, b.match.name);
  if (a.place->moved != b.place->moved) return b.place->moved;
  return a.place->id < b.place->id;
}

// The number that the text is; none if it is not a number of at most nine digits.
std::optional<long> wholeNumber(const std::string& text) {
  constexpr std::size_t kMostDigits = 9;
  long number = 0;
  const char* const end = text.data() + text.size();
  const auto read = std::from_chars(text.data(), end, number);
  if (text.size() > kMostDigits || read.ec != std::errc() || read.ptr != end || number < 0) return std::nullopt;
  return number;
}

// The first few names of the sorted places; if a number is searched for, the closest numbers come first.
std::vector<std::string> closestNames(const std::string& text, std::vector<FoundPlace> sorted) {
  const auto asked = wholeNumber(text);
  const auto off = [&](const FoundPlace& place) {
    const auto number = wholeNumber(place.match.name);
    return asked && number ? std::abs(*number - *asked) : std::numeric_limits<long>::max();
  };
  std::stable_sort(sorted.begin(), sorted.end(),
                   [&](const FoundPlace& a, const FoundPlace& b) { return off(a) < off(b); });
  std::vector<std::string> names;
  for (const auto& each : sorted) {
    if (names.size() == kMostNames) break;
    if (each.match.cost > kFarFetched && off(each) > kNextDoors) continue;
    if (std::find(names.begin(), names.end(), each.match.name) == names.end()) names.push_back(each.match.name);
  }
  return names;
}

}  // namespace

bool hasId(const map::Place& place, const std::string& id) {
  return toString(place.id) == id ||
         std::any_of(place.properties.begin(), place.properties.end(), [&](const map::Property& property) {
           const auto* text = std::get_if<std::string>(&property.value);
           if (property.name != map::kParts || !text) return false;
           const auto ids = partsOf(*text);
           return std::find(ids.begin(), ids.end(), id) != ids.end();
         });
}

std::vector<std::string> namesOf(const map::Place& place) {
  std::vector<std::string> names;
  for (const auto& name : {place.caption, place.label})
    if (!name.empty()) names.push_back(name);
  for (const auto& property : place.properties) {
    const auto* text = std::get_if<std::string>(&property.value);  // counts, measures and times are no names
    if (!text || text->empty() || property.name == map::kParts) continue;
    names.push_back(*text);
    const auto parts = partsOf(*text);
    if (parts.size() > 1) names.insert(names.end(), parts.begin(), parts.end());
    if (property.name == "words" && !place.caption.empty()) names.push_back(place.caption + ", " + *text);
  }
  return names;
}

Found find(const std::vector<map::Place>& places, const std::string& text) {
  expectText(text);
  std::vector<FoundPlace> all;
  for (const auto& place : places)
    if (hasId(place, text)) return {{{&place, {MatchGrade::exact, 0, text}}}, {}};
  const AskedText asked(text);
  std::vector<AskedText> others;
  for (const auto& word : otherWordsFor(text)) others.emplace_back(word);
  for (const auto& place : places) {
    const auto names = namesOf(place);
    TextMatch match = bestOf(asked, names);
    if (match.grade == MatchGrade::near)
      if (const auto other = asOtherWord(others, names)) match = *other;
    if (!match.name.empty()) all.push_back({&place, match});
  }
  std::sort(all.begin(), all.end(), isBefore);
  Found found;
  if (all.empty()) return found;
  constexpr double kAsNear = 0.1;
  const bool is_only_near = all.front().match.grade == MatchGrade::near;
  const double most = std::min(AskedText::kNear, all.front().match.cost + kAsNear);
  for (const auto& each : all) {
    const bool fits = is_only_near ? each.match.cost <= most : each.match.grade != MatchGrade::near;
    if (fits) found.places.push_back(each);
  }
  if (found.places.empty()) found.closest = closestNames(text, all);
  return found;
}

}  // namespace omnimapper::query
