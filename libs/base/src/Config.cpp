#include <omnimapper/base/Config.h>
#include <omnimapper/base/InputFile.h>

#include <algorithm>
#include <cctype>
#include <sstream>

#include "RenamedKeys.h"

namespace omnimapper::base {

namespace {

std::string trimmed(const std::string& text) {
  const auto first = text.find_first_not_of(" \t\r\n");
  if (first == std::string::npos) return "";
  return text.substr(first, text.find_last_not_of(" \t\r\n") - first + 1);
}

std::string lowerCase(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

// A comment starts with ';', '#' or "//" at the start of a line or after a blank.
std::string withoutComment(const std::string& text) {
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool starts = text[i] == ';' || text[i] == '#' || text.compare(i, 2, "//") == 0;
    if (starts && (i == 0 || text[i - 1] == ' ' || text[i - 1] == '\t')) return trimmed(text.substr(0, i));
  }
  return trimmed(text);
}

// The places of sections and keys, by section and key in lower case; the entry of a section itself has the key "".
using Places = std::map<std::pair<std::string, std::string>, std::string>;

std::pair<std::string, std::string> placeKey(const std::string& section, const std::string& key) {
  return {lowerCase(section), lowerCase(key)};  // MRPT's reader ignores case
}

// The INI reduced to "[section]" and "key = value", each on its original line. MRPT's reader silently keeps the last of
// two equal keys and ignores a line without '=': both are refused here, with their line.
std::string checkedText(const std::string& text, const std::string& file, Places& places) {
  const bool is_compressed = text.compare(0, 2, "\x1f\x8b") == 0 || text.compare(0, 3, "BZh") == 0;
  if (is_compressed || text.find('\0') != std::string::npos)
    throw Error(ExitCode::unknown_key,
                file + ": is not a text file, and so no INI file; a log is given with -r, as in -i INI -r LOG");
  const bool has_byte_order_mark = text.compare(0, 3, "\xEF\xBB\xBF") == 0;
  std::istringstream in(has_byte_order_mark ? text.substr(3) : text);
  std::ostringstream out;
  std::set<std::string> seen_sections, seen_keys;
  std::string line, section;
  for (int number = 1; std::getline(in, line); ++number) {
    const std::string place = file + ":" + std::to_string(number), at = place + ": ";
    const std::string body = withoutComment(line);
    if (body.empty()) {
      out << "\n";
      continue;
    }
    if (body.front() == '[') {
      if (body.back() != ']')
        throw Error(ExitCode::unknown_key, at + "a section is written [name], found '" + body + "'");
      section = trimmed(body.substr(1, body.size() - 2));
      if (!seen_sections.insert(lowerCase(section)).second) {  // MRPT's reader ignores case
        throw Error(ExitCode::unknown_key, at + "section [" + section + "] occurs twice; join the two");
      }
      seen_keys.clear();
      places[placeKey(section, "")] = place;
      out << "[" << section << "]\n";
      continue;
    }
    const auto equals = body.find('=');
    const std::string key = trimmed(body.substr(0, equals));
    if (equals == std::string::npos || key.empty() || section.empty()) {
      throw Error(ExitCode::unknown_key, at + "expected 'key = value' inside a [section], found '" + body + "'");
    }
    if (!seen_keys.insert(lowerCase(key)).second) {
      throw Error(ExitCode::unknown_key, at + "key '" + key + "' occurs twice in [" + section +
                                             "] (upper and lower case are the same); remove one");
    }
    places[placeKey(section, key)] = place;
    out << key << " = " << trimmed(body.substr(equals + 1)) << "\n";
  }
  return out.str();
}

std::size_t editDistance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({replaced, row[j] + 1, row[j - 1] + 1});
    }
  }
  return row[b.size()];
}

std::string suggestion(const std::string& name, const std::vector<std::string>& candidates) {
  const std::string near = nearestName(name, candidates);
  if (!near.empty()) return "; did you mean '" + near + "'?";
  return "; known: " + option_text::format(candidates);
}

}  // namespace

std::string nearestName(const std::string& name, const std::vector<std::string>& candidates) {
  // Very long names are skipped: comparing two of a megabyte would take hours.
  constexpr std::size_t kLongest = 200;
  if (name.size() > kLongest) return "";
  std::string best;
  std::size_t best_distance = std::max<std::size_t>(2, name.size() / 2) + 1;
  for (const auto& candidate : candidates) {
    constexpr std::size_t kLongEnough = 3;  // letters for a name to count as a shortened one
    const bool is_beginning =
        name.size() >= kLongEnough && lowerCase(candidate).compare(0, name.size(), lowerCase(name)) == 0;
    // The edit distance is at least the difference in length.
    if (!is_beginning && candidate.size() >= name.size() + best_distance) continue;
    const std::size_t distance = is_beginning ? 1 : editDistance(lowerCase(name), lowerCase(candidate));
    if (distance < best_distance) {
      best_distance = distance;
      best = candidate;
    }
  }
  return best;
}

Config Config::fromFile(const std::string& path) {
  const std::string text = readInput(path, "INI file");
  Config config = fromText(text, path);
  config.first_file_ = path;
  config.is_written_from_a_log_ = text.compare(0, kWrittenFromALog.size(), kWrittenFromALog) == 0;
  return config;
}

Config Config::fromFiles(const std::vector<std::string>& paths) {
  if (paths.empty()) return fromText("", "no INI");
  Config config = fromFile(paths.front());
  for (std::size_t i = 1; i < paths.size(); ++i) {
    const Config over = fromFile(paths[i]);
    std::vector<std::string> sections, keys;
    over.ini_.getAllSections(sections);
    for (const auto& section : sections) {
      over.ini_.getAllKeys(section, keys);
      for (const auto& key : keys) {
        config.refuseOtherSpelling(section, key, over.placeOf(section, key));
        config.ini_.write(section, key, over.ini_.read_string(section, key, ""));
      }
    }
    config.file_ += " + " + paths[i];
    for (const auto& [key, place] : over.places_) {
      config.places_[key] = place;
      config.from_later_files_.insert(key);
    }
  }
  return config;
}

Config Config::fromText(const std::string& text, const std::string& name_for_messages) {
  Config config;
  config.file_ = name_for_messages;
  const std::string checked = checkedText(text, name_for_messages, config.places_);
  try {
    config.ini_.setContent(checked);
  } catch (const std::exception& error) {  // MRPT expands ${name}, $env{NAME} and $eval{expression} in values
    throw Error(ExitCode::wrong_type, name_for_messages + ": " + error.what());
  }
  return config;
}

void Config::set(const std::string& assignment) {
  const auto equals = assignment.find('=');
  const auto dot = assignment.find('.');
  const bool has_parts = equals != std::string::npos && dot < equals;
  const std::string section = has_parts ? trimmed(assignment.substr(0, dot)) : "";
  const std::string key = has_parts ? trimmed(assignment.substr(dot + 1, equals - dot - 1)) : "";
  if (section.empty() || key.empty()) {
    throw Error(ExitCode::command_line,
                "--set " + assignment + ": expected section.key=value, such as --set mapper.window_s=2");
  }
  const std::string place = "--set " + section + "." + key;
  refuseOtherSpelling(section, key, place);
  ini_.write(section, key, trimmed(assignment.substr(equals + 1)));
  places_.emplace(placeKey(section, ""), place);
  places_[placeKey(section, key)] = place;
  from_later_files_.erase(placeKey(section, key));
}

// MRPT's reader ignores case and would assign the value to the key as it was first spelled.
void Config::refuseOtherSpelling(const std::string& section, const std::string& key, const std::string& place) const {
  std::vector<std::string> keys;
  if (has(section)) ini_.getAllKeys(section, keys);
  for (const auto& known : keys) {
    if (known == key || lowerCase(known) != lowerCase(key)) continue;
    throw Error(ExitCode::unknown_key, place + ": [" + section + "] has no key '" + key + "'; did you mean '" + known +
                                           "'? Upper and lower case matter");
  }
}

bool Config::isFromCommandLine(const std::string& section, const std::string& key) const {
  const auto place = places_.find(placeKey(section, key));
  return place != places_.end() && place->second.compare(0, 6, "--set ") == 0;
}

bool Config::isTrusted(const std::string& section, const std::string& key) const {
  const auto place = places_.find(placeKey(section, key));
  if (place == places_.end() || isFromCommandLine(section, key)) return true;
  return !is_written_from_a_log_ && from_later_files_.count(place->first) == 0;
}

std::string Config::placeOf(const std::string& section, const std::string& key) const {
  const auto place = places_.find(placeKey(section, key));
  return place == places_.end() ? file_ : place->second;
}

bool Config::has(const std::string& section) const {
  return ini_.sectionExists(section);
}

ConfigSection Config::section(const std::string& name) const {
  asked_.insert(name);
  return ConfigSection(*this, name);
}

std::vector<std::string> Config::unreadSections() const {
  std::vector<std::string> sections, unread;
  ini_.getAllSections(sections);
  for (const auto& section : sections) {
    if (!asked_.count(section) && !ini_.keyExists(section, "driver")) unread.push_back(section);
  }
  return unread;
}

void Config::refuseUnreadSections() const {
  refuseUnreadSections(Config());
}

void Config::refuseUnreadSections(const Config& before) const {
  std::set<std::string> asked = asked_;
  asked.insert(before.asked_.begin(), before.asked_.end());
  const std::vector<std::string> known(asked.begin(), asked.end());
  for (const auto& section : unreadSections()) {
    if (ini_.keyExists(section, "class") || asked.count(section) > 0 || before.has(section)) continue;
    throw Error(ExitCode::unknown_key,
                placeOf(section) + ": section [" + section + "] is not known" + suggestion(section, known));
  }
}

std::vector<std::string> Config::switchedOffPlugins() const {
  auto sections = unreadSections();
  const auto is_no_plugin = [&](const std::string& section) { return !ini_.keyExists(section, "class"); };
  sections.erase(std::remove_if(sections.begin(), sections.end(), is_no_plugin), sections.end());
  return sections;
}

bool ConfigSection::find(const std::string& key, std::string& text) const {
  if (config_->ini_.keyExists(name_, key)) {
    text = trimmed(config_->ini_.read_string(name_, key, ""));
    return true;
  }
  // An INI that a program wrote, such as that of a recording, keeps the names that the keys had then.
  if (!config_->is_written_from_a_log_) return false;
  for (const auto& [old, present] : renamedKeys()) {
    if (present != key || !config_->ini_.keyExists(name_, old)) continue;
    text = trimmed(config_->ini_.read_string(name_, old, ""));
    return true;
  }
  return false;
}

void ConfigSection::refuseUnknownKeys(const std::vector<OptionSpec>& specs,
                                      const std::vector<std::string>& also_known) const {
  std::vector<std::string> known = also_known;
  for (const auto& spec : specs) known.push_back(spec.key);
  std::vector<std::string> keys;
  if (config_->has(name_)) config_->ini_.getAllKeys(name_, keys);
  for (const auto& key : keys) {
    if (std::find(known.begin(), known.end(), key) != known.end()) continue;
    const auto renamed = renamedKeys().find(key);
    const bool is_old =
        renamed != renamedKeys().end() && std::find(known.begin(), known.end(), renamed->second) != known.end();
    if (is_old && config_->is_written_from_a_log_) continue;
    throw Error(ExitCode::unknown_key,
                config_->placeOf(name_, key) + ": [" + name_ + "] has no key '" + key + "'" +
                    (is_old ? ": it is called '" + renamed->second + "' now" : suggestion(key, known)));
  }
}

void ConfigSection::throwBadValue(const OptionSpec& spec, const std::string& text, const BadValue& bad) const {
  const std::string place = config_->placeOf(name_, spec.key) + ": [" + name_ + "] " + spec.key + " = '" + text + "'";
  const std::string remedy = " (default " + spec.default_value + ")";
  if (bad.kind == BadValue::Kind::range) {
    throw Error(ExitCode::out_of_range, place + " is out of range: must be " + bad.expected + remedy);
  }
  throw Error(ExitCode::wrong_type, place + " is not " + bad.expected + remedy);
}

}  // namespace omnimapper::base
