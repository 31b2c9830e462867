#include "RunFolder.h"

#include <omnimapper/base/AtomicFile.h>
#include <omnimapper/base/Error.h>

#include <filesystem>
#include <fstream>
#include <vector>

#include "FolderReadme.h"

namespace omnimapper::sim {

namespace fs = std::filesystem;

namespace {

const char kDraft[] = ".unfinished";

// Of the log that a simulator's page in the folder is about; empty if there is no such page.
std::string nameOfRunIn(const fs::path& folder) {
  std::ifstream page(folder / "README.md");
  std::string title;
  std::getline(page, title);
  return nameInTitle(title);
}

bool isEmpty(const fs::path& folder) {
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().filename() != kDraft) return false;
  }
  return true;
}

[[noreturn]] void fail(const std::string& folder, const std::string& reason) {
  throw base::Error(base::ExitCode::unwritable_output, folder + ": " + reason);
}

}  // namespace

RunFolder::RunFolder(const std::string& folder, const std::string& name)
    : folder_(folder), name_(name), draft_(folder + "/" + kDraft) {
  base::makeWritableFolder(folder);
  older_name_ = nameOfRunIn(folder);
  const bool was_begun = fs::exists(draft_);
  if (older_name_.empty() && !was_begun && !isEmpty(folder))
    fail(folder, "holds files but no simulated log, and they might be replaced; choose another with -o or empty it");
  std::error_code error;
  fs::remove_all(draft_, error);
  if (error) fail(folder, "what a run that was killed left cannot be removed (" + error.message() + ")");
  base::makeWritableFolder(draft_);
}

RunFolder::~RunFolder() {
  std::error_code ignored;
  fs::remove_all(draft_, ignored);
}

void RunFolder::publish() {
  const fs::path folder(folder_), draft(draft_);
  const std::string log = name_ + ".rawlog";
  try {
    for (const std::string& name : {older_name_, name_}) {
      if (name.empty()) continue;
      for (const char* ending : {".rawlog", ".ini", "_Images"}) fs::remove_all(folder / (name + ending));
    }
    for (const char* part : {"truth.tum", "landmarks.json", "plan.svg", "truth", "pictures"})
      fs::remove_all(folder / part);
    std::vector<fs::path> made;
    for (const auto& entry : fs::directory_iterator(draft)) {
      if (entry.path().filename() != log) made.push_back(entry.path().filename());
    }
    made.emplace_back(log);
    for (const fs::path& part : made) fs::rename(draft / part, folder / part);
  } catch (const fs::filesystem_error& error) {
    fail(folder_, std::string("an older run cannot be replaced (") + error.what() + ")");
  }
}

}  // namespace omnimapper::sim
