#include <omnimapper/base/Names.h>
#include <omnimapper/map/LabelEdits.h>

#include <algorithm>
#include <charconv>
#include <map>
#include <sstream>

namespace omnimapper::map {

namespace {

std::string trimmed(const std::string& text) {
  const auto first = text.find_first_not_of(" \t"), last = text.find_last_not_of(" \t");
  return first == std::string::npos ? "" : text.substr(first, last - first + 1);
}

std::string quoted(const std::string& text) {
  constexpr std::size_t kMost = 200;
  return "'" + base::printable(text.substr(0, kMost)) + "'";
}

/// The verb of a command and its texts, of which "rename" and "name" have two around " = ".
std::vector<std::string> wordsOf(const std::string& command) {
  const std::string text = trimmed(command);
  const auto blank = text.find(' ');
  std::vector<std::string> words{text.substr(0, blank)};
  const std::string rest = blank == std::string::npos ? "" : trimmed(text.substr(blank));
  if (rest.empty()) return words;
  const auto equals = words.front() == "rename" || words.front() == "name" ? rest.find(" = ") : std::string::npos;
  words.push_back(trimmed(rest.substr(0, equals)));
  if (equals != std::string::npos) words.push_back(trimmed(rest.substr(equals + 3)));
  return words;
}

}  // namespace

std::optional<std::string> whyNoLabel(const std::string& text) {
  constexpr std::size_t kLongest = 200;
  if (text.size() > kLongest) return "has " + std::to_string(text.size()) + " bytes; at most 200 are kept";
  if (trimmed(text).empty()) return "is empty";
  if (base::printable(text) != text) return "has control characters or is not UTF-8";
  return std::nullopt;
}

std::optional<NamedLandmark> namedLandmark(const std::string& command) {
  std::istringstream in(command);
  std::string verb, equals, text;
  char colon = 0;
  NamedLandmark named;
  if (!(in >> verb >> named.id.session >> colon >> named.id.index >> equals) || !std::getline(in, text))
    return std::nullopt;
  if (verb != "name" || colon != ':' || equals != "=") return std::nullopt;
  named.text = trimmed(text);
  return named;
}

std::string LabelEdits::commandOf(const std::vector<std::string>& words) {
  std::vector<std::string> plain;
  for (const auto& word : words) plain.push_back(trimmed(word));
  const auto is_none = [](const std::string& word) { return whyNoLabel(word).has_value(); };
  if (plain.empty() || std::any_of(plain.begin(), plain.end(), is_none)) return {};
  std::string command = plain.front();
  for (std::size_t i = 1; i < plain.size(); ++i) command += (i == 1 ? " " : " = ") + plain[i];
  static const std::map<std::string, std::size_t> sizes{{"name", 3}, {"rename", 3}, {"delete", 2}, {"undo", 1}};
  const auto size = sizes.find(plain.front());
  if (size == sizes.end() || plain.size() != size->second || wordsOf(command) != plain) return {};
  if (plain.front() != "name") return command;
  const auto named = namedLandmark(command);
  return named && toString(named->id) == plain[1] ? command : "";
}

void LabelEdits::keep() {
  constexpr std::size_t kMost = 100;
  if (before_.size() == kMost) before_.pop_front();
  before_.push_back(labels_);
}

void LabelEdits::begin(const Labels& labels) {
  labels_ = labels;
}

void LabelEdits::add(Label label) {
  keep();
  label.text = trimmed(label.text);
  labels_.question.reset();
  labels_.labels.push_back(std::move(label));
}

bool LabelEdits::has(const Label& label) const {
  return std::any_of(labels_.labels.begin(), labels_.labels.end(),
                     [&](const Label& each) { return each.text == label.text && each.landmark == label.landmark; });
}

void LabelEdits::ask(LabelQuestion question) {
  question.text = trimmed(question.text);
  labels_.question = std::move(question);
}

void LabelEdits::forgetQuestion() {
  labels_.question.reset();
}

LabelEdits::Outcome LabelEdits::edit(const std::string& command) {
  const auto words = wordsOf(command);
  const std::string& verb = words.front();
  const bool has_one_text = words.size() == 2;
  if (verb == "rename" && words.size() == 3) return rename(words[1], words[2]);
  if (verb == "rename") return {false, "rename needs OLD = NEW"};
  if (verb == "delete") return remove(has_one_text ? words[1] : "");
  if (verb == "choose") return choose(has_one_text ? words[1] : "");
  if (verb == "undo" && words.size() == 1) return undo();
  return {false, "no edit of labels: " + quoted(trimmed(command))};
}

LabelEdits::Outcome LabelEdits::rename(const std::string& from, const std::string& name) {
  const std::string to = trimmed(name);
  if (const auto why = whyNoLabel(to)) return {false, "the new label " + *why};
  const auto isIt = [&](const Label& label) { return label.text == from; };
  if (std::none_of(labels_.labels.begin(), labels_.labels.end(), isIt))
    return {false, "there is no label " + quoted(from)};
  keep();
  for (Label& label : labels_.labels)
    if (isIt(label)) label.text = to;
  return {true, quoted(from) + " is " + quoted(to) + " now"};
}

LabelEdits::Outcome LabelEdits::remove(const std::string& name) {
  const auto isIt = [&](const Label& label) { return label.text == name; };
  if (std::none_of(labels_.labels.begin(), labels_.labels.end(), isIt))
    return {false, "there is no label " + quoted(name)};
  keep();
  auto& labels = labels_.labels;
  labels.erase(std::remove_if(labels.begin(), labels.end(), isIt), labels.end());
  return {true, quoted(name) + " is deleted"};
}

LabelEdits::Outcome LabelEdits::choose(const std::string& number) {
  if (!labels_.question) return {false, "there is no question"};
  const LabelQuestion question = *labels_.question;
  std::size_t chosen = 0;
  const auto end = number.data() + number.size();
  const auto read = std::from_chars(number.data(), end, chosen);
  if (read.ec != std::errc() || read.ptr != end || chosen < 1 || chosen > question.choices.size())
    return {false, "choose needs a number from 1 to " + std::to_string(question.choices.size())};
  const auto& choice = question.choices[chosen - 1];
  add({question.text, choice.landmark, question.frame, choice.in_frame, question.who, question.when, 1});
  return {true, quoted(question.text) + " is chosen"};
}

LabelEdits::Outcome LabelEdits::undo() {
  if (before_.empty()) return {false, "there is nothing to undo in this run"};
  labels_ = before_.back();
  before_.pop_back();
  return {true, "the last change is undone"};
}

}  // namespace omnimapper::map
