#include <gtest/gtest.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/base/InputFile.h>
#include <omnimapper/testing/Fixtures.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fstream>
#include <string>

namespace omnimapper::base::input_file_test {
namespace {

using testing::ScratchFolder;

// The message for a path that is refused; also checks that the exit code is that of an unreadable input.
std::string refusal(const std::string& path) {
  try {
    readInput(path);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::unreadable_input);
    return error.what();
  }
  return "read";
}

std::string written(const std::string& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
  return path;
}

TEST(InputFile, IsReadByteForByte) {
  const ScratchFolder folder;
  const std::string bytes("a\r\n\0\xff\n", 6), path = written(folder / "bytes", bytes);
  EXPECT_EQ(readInput(path), bytes);
  EXPECT_EQ(readInput(written(folder / "empty", "")), "");
  ASSERT_EQ(symlink(path.c_str(), (folder / "link").c_str()), 0);
  EXPECT_EQ(readInput(folder / "link"), bytes);
}

TEST(InputFile, WhatIsNoneIsRefusedByNameAndReason) {
  const ScratchFolder folder;
  const std::string pipe = folder / "pipe", absent = folder / "absent";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_EQ(refusal(pipe), pipe + ": is a pipe or a device and no file");
  EXPECT_EQ(refusal("/dev/zero"), "/dev/zero: is a pipe or a device and no file");
  EXPECT_EQ(refusal(folder / "."), std::string(folder / ".") + ": is a folder and no file");
  EXPECT_EQ(refusal(absent), absent + ": this file cannot be opened: No such file or directory; is the path right?");
}

}  // namespace
}  // namespace omnimapper::base::input_file_test
