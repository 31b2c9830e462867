#include <gtest/gtest.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/testing/Fixtures.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <iterator>
#include <optional>

#include "LogWriters.h"
#include "ros_log/LogFiles.h"
#include "ros_log/MessageReader.h"

namespace omnimapper::ros::container_test {
namespace {

using namespace ros_test;

const std::vector<Topic> kTopics = {{"/a", "std_msgs/String", "string data\n"},
                                    {"/b", "std_msgs/String", "string data\n"}};

// Seven messages on two topics, a second apart.
std::vector<Written> sevenMessages() {
  std::vector<Written> messages;
  for (std::size_t i = 0; i < 7; ++i)
    messages.push_back({i % 2, static_cast<std::int64_t>(i + 1) * 1'000'000'000, "message " + std::to_string(i)});
  return messages;
}
const std::string kAll = "0123456";

class LogOf : public ::testing::Test {
 protected:
  // The last letters of the messages of a log, in the order in which they are read.
  std::string read(const std::string& path) {
    Channels channels;
    MessageReader reader(LogFiles(path).present, channels);
    std::string letters;
    std::int64_t before = 0;
    while (const auto message = reader.next()) {
      letters += message->bytes.empty() ? '?' : message->bytes.back();
      EXPECT_GE(message->time, before);
      EXPECT_EQ(channels[message->channel].topic, (letters.back() - '0') % 2 == 0 ? "/a" : "/b");
      before = message->time;
    }
    damage_ = reader.damage();
    notes_ = reader.notes();
    EXPECT_EQ(reader.progress(), 1.0);
    return letters;
  }
  std::string readText(const std::string& text) {
    std::ofstream(path_, std::ios::binary) << text;
    return read(path_);
  }
  std::string refusal(const std::string& path) {
    try {
      return "read: " + read(path);
    } catch (const base::Error& error) {
      return error.what();
    }
  }
  testing::ScratchFolder folder_;
  std::string path_ = folder_ / "log";
  Damage damage_;
  std::vector<std::string> notes_;
};

TEST_F(LogOf, aBagIsReadWhateverItsCompression) {
  for (const char* compression : {"none", "bz2", "lz4"}) {
    BagWriter writer;
    writer.compression = compression;
    EXPECT_EQ(readText(writer.text(kTopics, sevenMessages())), kAll) << compression;
    EXPECT_EQ(damage_.what, "");
  }
}

TEST_F(LogOf, aBagWithoutIndexOrChunksIsRead) {
  BagWriter writer;
  writer.is_indexed = false;
  EXPECT_EQ(readText(writer.text(kTopics, sevenMessages())), kAll);
  ASSERT_EQ(notes_.size(), 1u);
  EXPECT_NE(notes_[0].find("was not closed"), std::string::npos);
  writer.has_chunks = false;
  EXPECT_EQ(readText(writer.text(kTopics, sevenMessages())), kAll);
  EXPECT_EQ(damage_.what, "");
}

TEST_F(LogOf, chunksAndMessagesAreSortedByTheirTimes) {
  BagWriter writer;
  writer.order = {3, 1, 0, 2};
  EXPECT_EQ(readText(writer.text(kTopics, sevenMessages())), kAll);
  auto messages = sevenMessages();
  std::swap(messages[1], messages[6]);
  EXPECT_EQ(readText(writer.text(kTopics, messages)), kAll);
}

TEST_F(LogOf, aTruncatedBagIsReadAsFarAsItGoes) {
  const std::string whole = BagWriter().text(kTopics, sevenMessages());
  std::string before;
  for (std::size_t size = 4200; size < whole.size(); size += 97) {
    const std::string letters = readText(whole.substr(0, size));
    EXPECT_EQ(letters, kAll.substr(0, letters.size())) << size;
    EXPECT_GE(letters.size(), before.size()) << size;
    before = letters;
  }
  readText(whole.substr(0, whole.size() - 10));
  EXPECT_TRUE(damage_.is_cut);
}

TEST_F(LogOf, aDamagedRecordOfABagIsSkippedWithTheIndexAtItsEnd) {
  // Bags of 2010 state more bytes for an index than it has.
  std::string text = BagWriter().text(kTopics, sevenMessages());
  const std::string entries = number(24, 4) + number(1, 4);  // data of two entries, of which the first is at 1 s
  const auto at = text.find(entries);
  ASSERT_NE(at, std::string::npos);
  text.replace(at, 4, number(40, 4));
  EXPECT_EQ(readText(text), kAll);
  EXPECT_EQ(damage_.what, "");
}

TEST_F(LogOf, aBagWhoseIndexIsAtAnImpossiblePlaceIsReadAsFarAsItGoes) {
  std::string text = BagWriter().text(kTopics, sevenMessages());
  const std::string name = "index_pos=";
  text.replace(text.find(name) + name.size(), 8, std::string(8, '\xff'));
  EXPECT_EQ(readText(text), kAll);
  EXPECT_EQ(readText(text.substr(0, text.size() - 10)), kAll);
  EXPECT_TRUE(damage_.is_cut);
}

TEST_F(LogOf, aMessageWithoutAChunkThatStatesTooMuchEndsTheBagBeforeIt) {
  BagWriter writer;
  writer.has_chunks = writer.is_indexed = false;
  std::string text = writer.text(kTopics, sevenMessages());
  text.replace(text.find("message 3") - 4, 4, number(200'000'000, 4));
  EXPECT_EQ(readText(text), "012");
  EXPECT_NE(damage_.what, "");
  Channels channels;
  const auto bag = openContainer(path_, channels);
  for (const auto& chunk : bag->chunks()) EXPECT_LE(chunk.offset + chunk.size, text.size());
}

TEST_F(LogOf, aMessageThatIsKeptDoesNotHoldItsChunk) {
  BagWriter().write(path_, kTopics, sevenMessages());
  Channels channels;
  const auto message = openContainer(path_, channels)->load(0).at(1);
  const Message kept = detached(message);
  EXPECT_EQ(kept.bytes, "message 1");
  EXPECT_EQ(kept.time, message.time);
  EXPECT_EQ(kept.buffer->size(), kept.bytes.size());
  EXPECT_LT(kept.buffer->size(), message.buffer->size());
}

TEST_F(LogOf, anOldOrEncryptedBagIsRefusedByName) {
  std::ofstream(path_, std::ios::binary) << "#ROSRECORD V1.2\n" << std::string(100, ' ');
  EXPECT_NE(refusal(path_).find("V1.2"), std::string::npos) << refusal(path_);
  EXPECT_NE(refusal(path_).find("rosbag fix"), std::string::npos);
}

TEST_F(LogOf, anMcapIsReadWhateverItsCompression) {
  for (const char* compression : {"", "lz4", "zstd"}) {
    McapWriter writer;
    writer.compression = compression;
    EXPECT_EQ(readText(writer.text(kTopics, sevenMessages())), kAll) << compression;
    EXPECT_EQ(damage_.what, "");
    writer.has_end = false;
    EXPECT_EQ(readText(writer.text(kTopics, sevenMessages())), kAll) << compression;
    EXPECT_TRUE(damage_.is_cut);
  }
}

TEST_F(LogOf, anMcapWithoutChunksIsReadAndATruncatedOneAsFarAsItGoes) {
  McapWriter writer;
  writer.has_chunks = false;
  const std::string whole = writer.text(kTopics, sevenMessages());
  EXPECT_EQ(readText(whole), kAll);
  for (std::size_t size = 40; size + 40 < whole.size(); size += 31) {
    const std::string letters = readText(whole.substr(0, size));
    EXPECT_EQ(letters.substr(0, letters.size() - (letters.empty() ? 0 : 1)),
              kAll.substr(0, letters.size() - (letters.empty() ? 0 : 1)));
    EXPECT_TRUE(damage_.is_cut) << size;
  }
}

TEST_F(LogOf, aChunkWithAWrongChecksumIsLeftOut) {
  McapWriter writer;
  writer.has_wrong_checksum = true;
  EXPECT_EQ(readText(writer.text(kTopics, sevenMessages())), "");
  EXPECT_NE(damage_.what.find("wrong checksum"), std::string::npos);
}

TEST_F(LogOf, anSqliteFileIsReadWithAndWithoutCompressedMessages) {
  Db3Writer writer;
  writer.write(folder_ / "plain.db3", kTopics, sevenMessages());
  EXPECT_EQ(read(folder_ / "plain.db3"), kAll);
  writer.packs_messages = true;
  writer.write(folder_ / "a file?with #signs%.db3", kTopics, sevenMessages());
  EXPECT_EQ(read(folder_ / "a file?with #signs%.db3"), kAll);
}

TEST_F(LogOf, aTruncatedSqliteFileIsReadAsFarAsItGoes) {
  std::vector<Written> messages;
  for (std::size_t i = 0; i < 300; ++i)
    messages.push_back({0, static_cast<std::int64_t>(i + 1) * 1'000'000'000, std::string(500, 'x') + "0"});
  const std::string whole = folder_ / "whole.db3";
  Db3Writer().write(whole, kTopics, messages);
  EXPECT_EQ(read(whole).size(), 300u);
  std::filesystem::resize_file(whole, std::filesystem::file_size(whole) / 2);
  const std::size_t count = read(whole).size();
  EXPECT_GT(count, 100u);
  EXPECT_LT(count, 300u);
  EXPECT_TRUE(damage_.is_cut);
}

TEST_F(LogOf, anSqliteFileOfAnotherKindIsRefused) {
  sqlite3* database = nullptr;
  sqlite3_open(path_.c_str(), &database);
  sqlite3_exec(database, "CREATE TABLE friends(name TEXT)", nullptr, nullptr, nullptr);
  sqlite3_close(database);
  EXPECT_NE(refusal(path_).find("without the tables topics and messages"), std::string::npos) << refusal(path_);
}

TEST_F(LogOf, aSplitLogIsReadInTheOrderOfItsTimesAndMissingFilesAreNamed) {
  const auto all = sevenMessages();
  const std::string folder = folder_ / "split";
  std::filesystem::create_directory(folder);
  Db3Writer().write(folder + "/log_1.db3", kTopics, {all[4], all[5], all[6]});
  McapWriter().write(folder + "/log_0.mcap", kTopics, {all[0], all[1], all[2], all[3]});
  EXPECT_EQ(read(folder), kAll);
  std::ofstream(folder + "/metadata.yaml")
      << "rosbag2_bagfile_information:\n  version: 4\n  relative_file_paths:\n    - log_1.db3\n    - log_2.db3\n";
  EXPECT_EQ(read(folder), "456");
  EXPECT_EQ(LogFiles(folder).missing, std::vector<std::string>{folder + "/log_2.db3"});
  EXPECT_EQ(LogFiles(folder).left_out, std::vector<std::string>{folder + "/log_0.mcap"});
}

TEST_F(LogOf, ofSeveralInAFolderNoneIsTaken) {
  const std::string folder = folder_ / "several";
  const auto isOne = [&](const std::vector<std::string>& names) {
    std::filesystem::remove_all(folder);
    std::filesystem::create_directory(folder);
    for (const auto& name : names) std::ofstream(folder + "/" + name) << "x";
    const std::string said = refusal(folder);
    if (said.find("holds several logs") == std::string::npos) return true;
    for (const auto& name : names) EXPECT_NE(said.find(name), std::string::npos) << said;
    return false;
  };
  EXPECT_TRUE(isOne({"a.mcap"}));
  EXPECT_TRUE(isOne({"a_0.db3", "a_1.db3", "a_10.db3.zstd", "notes.txt"}));
  EXPECT_TRUE(isOne({"2026_12_01_0.mcap", "2026_12_01_1.mcap"}));
  EXPECT_FALSE(isOne({"a.bag", "b.bag", "c.mcap"}));
  EXPECT_FALSE(isOne({"c.mcap", "c.rawlog"}));
  EXPECT_FALSE(isOne({"a.mcap", "b.mcap"}));
  EXPECT_FALSE(isOne({"2026_12_01_0.db3", "2026_12_02_0.db3"}));
  EXPECT_FALSE(isOne({"a_0.db3", "a_0.db3.zstd"})) << "its messages would come twice";
}

TEST_F(LogOf, whatIsCompressedAsAWholeIsSaidWithItsRemedy) {
  const std::string bag = BagWriter().text(kTopics, sevenMessages());
  const std::string xz("\xfd\x37zXZ\0\0\x04", 8);
  for (const auto& [ending, bytes, remedy] :
       std::vector<std::array<std::string, 3>>{{".gz", "\x1f\x8b\x08 and so on", "gzip -dk"},
                                               {".bz2", packed("bz2", bag), "bzip2 -dk"},
                                               {".xz", xz, "xz -dk"}}) {
    const std::string path = path_ + ".bag" + ending;
    std::ofstream(path, std::ios::binary) << bytes;
    const std::string said = refusal(path);
    EXPECT_NE(said.find("unpack it first: " + remedy + " " + path), std::string::npos) << said;
  }
  const std::string zst = path_ + ".bag.zst";
  std::ofstream(zst, std::ios::binary) << packed("zstd", bag);
  EXPECT_TRUE(looksLikeRos(source::LogLook::at(zst)));
  EXPECT_EQ(read(zst), kAll);
}

std::string contentOf(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

// What is unpacked goes to a folder of the test.
class PackedLog : public LogOf {
 protected:
  PackedLog() {
    std::filesystem::create_directory(temporary_);
    if (const char* before = std::getenv("TMPDIR")) before_ = before;
    ::setenv("TMPDIR", temporary_.c_str(), 1);
  }
  ~PackedLog() override {
    before_ ? ::setenv("TMPDIR", before_->c_str(), 1) : ::unsetenv("TMPDIR");
    EXPECT_TRUE(std::filesystem::is_empty(temporary_));
  }
  std::string temporary_ = folder_ / "temporary";
  std::optional<std::string> before_;
};

TEST_F(PackedLog, ofEachKindIsUnpacked) {
  const std::string plain = folder_ / "plain.db3";
  Db3Writer().write(plain, kTopics, sevenMessages());
  for (const auto& text :
       {McapWriter().text(kTopics, sevenMessages()), BagWriter().text(kTopics, sevenMessages()), contentOf(plain)}) {
    EXPECT_EQ(readText(packed("zstd", text)), kAll);
    EXPECT_EQ(damage_.what, "");
  }
  EXPECT_NE(refusal(path_ + "none").find("No such file"), std::string::npos);
  std::ofstream(path_, std::ios::binary) << packed("zstd", packed("zstd", contentOf(plain)));
  EXPECT_NE(refusal(path_).find("is no log of ROS"), std::string::npos) << refusal(path_);
}

TEST_F(PackedLog, isReadUpToItsDamage) {
  const std::string text = McapWriter().text(kTopics, sevenMessages());
  const std::string first = packed("zstd", text.substr(0, text.size() / 2));
  const std::string second = packed("zstd", text.substr(text.size() / 2));
  const std::string cut = readText(first + second.substr(0, second.size() - 5));
  EXPECT_EQ(cut, kAll.substr(0, cut.size()));
  EXPECT_GT(cut.size(), 1u);
  EXPECT_TRUE(damage_.is_cut);
  EXPECT_NE(damage_.what.find("compressed data"), std::string::npos) << damage_.what;
  EXPECT_EQ(readText(first + "this is no frame of Zstandard"), cut);
  EXPECT_FALSE(damage_.is_cut);
  EXPECT_NE(damage_.what.find("Zstandard"), std::string::npos) << damage_.what;
}

}  // namespace
}  // namespace omnimapper::ros::container_test
