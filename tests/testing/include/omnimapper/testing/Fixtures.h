#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <optional>
#include <string>

namespace omnimapper::testing {

/// Whether this is a build with a sanitizer. The test and the programs that it starts are then some ten times slower,
/// and their memory cannot be limited.
#if defined(__has_feature)
#define OMNIMAPPER_HAS_FEATURE(feature) __has_feature(feature)
#else
#define OMNIMAPPER_HAS_FEATURE(feature) 0
#endif
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__) || OMNIMAPPER_HAS_FEATURE(address_sanitizer) || \
    OMNIMAPPER_HAS_FEATURE(thread_sanitizer)
inline constexpr bool kIsSanitized = true;
#else
inline constexpr bool kIsSanitized = false;
#endif

/// A temporary folder for one test. The destructor removes it with its content.
class ScratchFolder {
 public:
  ScratchFolder();
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  const std::string& path() const { return path_; }
  /// Path of a file in the folder.
  std::string operator/(const std::string& name) const { return path_ + "/" + name; }

 private:
  std::string path_;
};

/// While this object exists, no file of the process can grow beyond the limit [bytes]; a write fails as on a full disk.
class SmallFiles {
 public:
  explicit SmallFiles(std::uint64_t bytes);
  ~SmallFiles();
  SmallFiles(const SmallFiles&) = delete;
  SmallFiles& operator=(const SmallFiles&) = delete;

 private:
  std::uint64_t before_;
  void (*handler_)(int);
};

/// Path of a file in the project's source tree, such as "ini/laser2d.ini".
std::string sourceFile(const std::string& relative);
/// Path of a recording beside the project (in the folder OMNIMAPPER_DATA of the environment, else in ../shared/data),
/// if it exists.
std::optional<std::string> sharedData(const std::string& relative);
/// Path of a data set in the Debian package mrpt-common, if it exists.
std::optional<std::string> mrptDataset(const std::string& relative);

/// Whether this build has the feature that reads logs of this format.
bool hasFormat(const std::string& format);

}  // namespace omnimapper::testing

/// Skips a test whose recording is not on this machine. scripts/test counts and prints skipped tests.
#define OMNIMAPPER_NEEDS(optional_path) \
  if (!(optional_path)) GTEST_SKIP() << "recording not on this machine; the simulated twin of this test has run"

/// Skips a test of a recording whose format this build leaves out.
#define OMNIMAPPER_NEEDS_FORMAT(format) \
  if (!omnimapper::testing::hasFormat(format)) GTEST_SKIP() << "this build does not read the format " << (format)
