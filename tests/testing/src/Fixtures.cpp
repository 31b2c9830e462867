#include <omnimapper/base/FeatureLibraries.h>
#include <omnimapper/testing/Fixtures.h>
#include <signal.h>
#include <stdlib.h>
#include <sys/resource.h>

#include <filesystem>

namespace omnimapper::testing {

namespace fs = std::filesystem;

namespace {
std::optional<std::string> ifPresent(const fs::path& path) {
  if (fs::exists(path)) return path.string();
  return std::nullopt;
}
}  // namespace

ScratchFolder::ScratchFolder() {
  std::string pattern = (fs::temp_directory_path() / "omnimapper-test-XXXXXX").string();
  if (!::mkdtemp(pattern.data())) throw std::runtime_error("cannot make a scratch folder in " + pattern);
  path_ = pattern;
}

ScratchFolder::~ScratchFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

SmallFiles::SmallFiles(std::uint64_t bytes) : handler_(::signal(SIGXFSZ, SIG_IGN)) {
  rlimit limit{};
  ::getrlimit(RLIMIT_FSIZE, &limit);
  before_ = limit.rlim_cur;
  limit.rlim_cur = bytes;
  ::setrlimit(RLIMIT_FSIZE, &limit);
}

SmallFiles::~SmallFiles() {
  rlimit limit{};
  ::getrlimit(RLIMIT_FSIZE, &limit);
  limit.rlim_cur = before_;
  ::setrlimit(RLIMIT_FSIZE, &limit);
  ::signal(SIGXFSZ, handler_);
}

std::string sourceFile(const std::string& relative) {
  return std::string(OMNIMAPPER_SOURCE_DIR) + "/" + relative;
}

std::optional<std::string> sharedData(const std::string& relative) {
  const char* folder = std::getenv("OMNIMAPPER_DATA");
  return ifPresent(fs::path(folder ? folder : sourceFile("../shared/data")) / relative);
}

std::optional<std::string> mrptDataset(const std::string& relative) {
  return ifPresent(fs::path("/usr/share/mrpt/datasets") / relative);
}

bool hasFormat(const std::string& format) {
  base::loadFeaturesOf(base::Registered::format);
  return base::whyUnavailable(format).empty();
}

}  // namespace omnimapper::testing
