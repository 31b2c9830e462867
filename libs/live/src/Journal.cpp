#include <omnimapper/base/Config.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/base/InputFile.h>
#include <omnimapper/live/Journal.h>

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <filesystem>
#include <string_view>

namespace omnimapper::live {

namespace {

const std::string kFirstLine = "omnimapper journal 1", kExtension = ".journal";

// Reads a line: a NUMBER, d NUMBER, p NUMBER, b or j.
std::optional<JournalEvent> eventOf(std::string_view line) {
  JournalEvent event;
  if (line == "b" || line == "j") {
    event.kind = line == "b" ? JournalEvent::Kind::bundle : JournalEvent::Kind::job;
    return event;
  }
  if (line.size() < 3 || (line[0] != 'a' && line[0] != 'd' && line[0] != 'p') || line[1] != ' ') return std::nullopt;
  event.kind = line[0] == 'a'   ? JournalEvent::Kind::add
               : line[0] == 'd' ? JournalEvent::Kind::drop
                                : JournalEvent::Kind::plugins;
  const auto end = line.data() + line.size();
  const auto [rest, error] = std::from_chars(line.data() + 2, end, event.number);
  return error == std::errc() && rest == end ? std::make_optional(event) : std::nullopt;
}

[[noreturn]] void refuse(const std::string& path, const std::string& reason) {
  throw base::Error(base::ExitCode::unreadable_input, path + ": " + reason);
}

std::vector<std::string> rawlogsBeside(const std::string& path) {
  const std::string stem = std::filesystem::path(path).replace_extension().string();
  std::vector<std::string> rawlogs;
  for (std::size_t i = 0;; ++i) {
    char number[32] = "";
    if (i > 0) std::snprintf(number, sizeof number, "_%03zu", i);
    std::string rawlog = stem + number + ".rawlog";
    if (!std::filesystem::exists(rawlog)) break;
    rawlogs.push_back(std::move(rawlog));
  }
  if (rawlogs.empty()) refuse(path, "the recording " + stem + ".rawlog is missing beside the journal");
  return rawlogs;
}

}  // namespace

JournalWriter::JournalWriter(const std::string& path) : file_(path, std::ios::binary) {
  file_ << kFirstLine << "\n" << std::flush;
  if (!file_) throw base::Error(base::ExitCode::unwritable_output, path + ": the journal cannot be written");
}

void JournalWriter::add(const JournalEvent& event) {
  switch (event.kind) {
    case JournalEvent::Kind::add:
      file_ << "a " << event.number << "\n";
      break;
    case JournalEvent::Kind::drop:
      file_ << "d " << event.number << "\n";
      break;
    case JournalEvent::Kind::plugins:
      file_ << "p " << event.number << "\n";
      break;
    case JournalEvent::Kind::bundle:
      file_ << "b\n";
      break;
    case JournalEvent::Kind::job:
      file_ << "j\n";
      break;
  }
}

bool JournalWriter::flush() {
  return static_cast<bool>(file_.flush());
}

Journal Journal::read(const std::string& path) {
  if (std::filesystem::path(path).extension() != kExtension)
    refuse(path, "the name of a journal must end in " + kExtension);
  const std::string text = base::readInput(path, "journal of a live run");
  if (text.compare(0, kFirstLine.size() + 1, kFirstLine + "\n") != 0) refuse(path, "not a journal of a live run");
  Journal journal;
  std::size_t line = 1;
  for (std::size_t begin = kFirstLine.size() + 1, end; (end = text.find('\n', begin)) != std::string::npos;
       begin = end + 1) {
    const auto event = eventOf(std::string_view(text).substr(begin, end - begin));
    if (!event) refuse(path, "line " + std::to_string(line + 1) + " is damaged");
    journal.events.push_back(*event);
    ++line;
  }
  journal.rawlogs = rawlogsBeside(path);
  return journal;
}

std::string findJournal(const std::string& path) {
  namespace fs = std::filesystem;
  std::error_code none;
  if (!fs::is_directory(path, none)) return path;
  std::vector<std::string> found;
  for (const auto& folder : {fs::path(path), fs::path(path) / "recording"}) {
    for (const auto& entry : fs::directory_iterator(folder, none))
      if (entry.path().extension() == kExtension) found.push_back(entry.path().string());
  }
  if (found.empty()) refuse(path, "neither this folder nor its subfolder recording has the journal of a live run");
  if (found.size() == 1) return found.front();
  std::sort(found.begin(), found.end());
  refuse(path, "several live runs were recorded there; name the journal of one: " + found.front() + " or " +
                   (found.size() == 2 ? found.back() : "one of " + std::to_string(found.size() - 1) + " others"));
}

std::string iniOf(const std::string& journal, std::uint64_t change) {
  const std::string number = change == 0 ? "" : "." + std::to_string(change);
  return std::filesystem::path(journal).replace_extension().string() + number + ".ini";
}

std::optional<std::string> findIni(const std::string& journal, std::uint64_t change) {
  const std::string ini = iniOf(journal, change);
  if (!std::filesystem::exists(ini)) return std::nullopt;
  if (base::readInput(ini, "INI of the live run").compare(0, base::kWrittenFromALog.size(), base::kWrittenFromALog) !=
      0)
    refuse(ini, "no live run wrote this INI; name it with -i to use it");
  return ini;
}

}  // namespace omnimapper::live
