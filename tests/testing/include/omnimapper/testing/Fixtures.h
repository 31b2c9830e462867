#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <optional>
#include <string>

namespace omnimapper::testing {

/// Whether this is a sanitizer's build: some ten times slower, processes too, and their memory cannot be limited.
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

/// A folder of its own for one test, removed with its content at the end.
class ScratchFolder {
 public:
  ScratchFolder();
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  const std::string& path() const { return path_; }
  /// Path of a file in it.
  std::string operator/(const std::string& name) const { return path_ + "/" + name; }

 private:
  std::string path_;
};

/// While it lives, no file of this process grows beyond so many bytes: a write fails as on a full disk.
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

/// A file of the project's source tree, such as "ini/laser2d.ini".
std::string sourceFile(const std::string& relative);
/// A recording kept beside the project (environment OMNIMAPPER_DATA, else ../shared/data), if it is there.
std::optional<std::string> sharedData(const std::string& relative);
/// A data set of the Debian package mrpt-common, if it is there.
std::optional<std::string> mrptDataset(const std::string& relative);

}  // namespace omnimapper::testing

/// Leaves a test whose recording is not on this machine; scripts/test counts and prints these.
#define OMNIMAPPER_NEEDS(optional_path) \
  if (!(optional_path)) GTEST_SKIP() << "recording not on this machine; the simulated twin of this test has run"
