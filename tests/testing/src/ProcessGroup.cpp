#include "ProcessGroup.h"

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

namespace omnimapper::testing {

namespace {

struct Stat {
  char state = 'Z';
  pid_t group = 0;
  double processor_seconds = 0;
};

// Of a file /proc/PROCESS/stat or /proc/PROCESS/task/THREAD/stat; its name in parentheses may contain anything.
Stat readStat(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::string text;
  std::getline(file, text, '\0');  // empty if the process ends meanwhile
  const auto name_end = text.rfind(')');
  Stat stat;
  if (name_end == std::string::npos) return stat;
  std::istringstream words(text.substr(name_end + 1));
  std::string skipped;
  pid_t parent = 0;
  long user = 0, system = 0;
  words >> stat.state >> parent >> stat.group;
  for (int i = 0; i < 8; ++i) words >> skipped;
  words >> user >> system;
  stat.processor_seconds = double(user + system) / double(::sysconf(_SC_CLK_TCK));
  return stat;
}

}  // namespace

ProcessGroup lookAtProcessGroup(pid_t group) {
  namespace fs = std::filesystem;
  ProcessGroup all;
  std::error_code gone;  // processes and threads end while they are listed
  for (fs::directory_iterator process("/proc", gone), end; process != end; process.increment(gone)) {
    const std::string name = process->path().filename();
    if (name.find_first_not_of("0123456789") != std::string::npos) continue;
    const Stat stat = readStat(process->path() / "stat");
    if (stat.group != group) continue;
    all.processor_seconds += stat.processor_seconds;
    for (fs::directory_iterator thread(process->path() / "task", gone); thread != end; thread.increment(gone)) {
      const char state = readStat(thread->path() / "stat").state;
      all.has_work = all.has_work || state == 'R' || state == 'D';
    }
  }
  return all;
}

}  // namespace omnimapper::testing
