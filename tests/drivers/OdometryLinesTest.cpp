#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <mrpt/config/CConfigFileMemory.h>
#include <netinet/in.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/drivers/COdometryLines.h>
#include <omnimapper/live/HostClock.h>
#include <omnimapper/live/LiveSource.h>
#include <omnimapper/live/SensorDriver.h>
#include <omnimapper/live/Socket.h>
#include <omnimapper/testing/ChildProgram.h>
#include <omnimapper/testing/Fixtures.h>
#include <sys/socket.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <thread>

namespace omnimapper::drivers::odometry_lines_test {
namespace {

using namespace live;

using mrpt::obs::CObservationOdometry;

/// A robot's own program, which sends lines.
class Client {
 public:
  explicit Client(std::uint16_t port, int type = SOCK_STREAM) : socket_(::socket(AF_INET, type | SOCK_NONBLOCK, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(port);
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    connect(socket_.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address);
  }
  // The number of bytes that were sent.
  std::size_t send(const std::string& bytes) {
    const auto size = ::send(socket_.get(), bytes.data(), bytes.size(), MSG_NOSIGNAL);
    return size > 0 ? static_cast<std::size_t>(size) : 0;
  }
  // Whether the other side has closed the connection.
  bool wasClosed() {
    char byte = 0;
    return recv(socket_.get(), &byte, 1, 0) == 0 || (errno != EAGAIN && errno != EWOULDBLOCK);
  }
  void close() { socket_.close(); }

 private:
  Descriptor socket_;
};

class OdometryLinesTest : public ::testing::Test {
 protected:
  void open(const std::string& keys = "") {
    mrpt::config::CConfigFileMemory ini;
    ini.setContent("[wheels]\nsensorLabel = wheels\nport = 0\n" + keys);
    sensor.loadConfig(ini, "wheels");
    sensor.initialize();
  }
  // The positions x of all observations of the next tenth of a second, or, with `count`, until so many have come.
  std::vector<double> take(std::size_t count = 0) {
    std::vector<double> all;
    const auto begin = std::chrono::steady_clock::now();
    do {
      sensor.doProcess();
      for (const auto& [stamp, object] : sensor.getObservations()) {
        const auto odometry = std::dynamic_pointer_cast<CObservationOdometry>(object);
        EXPECT_EQ(odometry->sensorLabel, "wheels");
        EXPECT_EQ(odometry->timestamp, stamp);
        all.push_back(odometry->odometry.x());
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    } while (count > 0 ? all.size() < count
                       : std::chrono::steady_clock::now() - begin < std::chrono::milliseconds(100));
    return all;
  }
  static std::string line(double x, double seconds_ago = 0) {
    return base::formatUnix(hostNow() - base::durationFromSeconds(seconds_ago)) + " " + std::to_string(x) + " 0 0\n";
  }

  COdometryLines sensor;
};

using Positions = std::vector<double>;

TEST_F(OdometryLinesTest, linesBecomeObservationsInWhateverPiecesTheyCome) {
  open();
  Client client(sensor.port());
  const std::string text = "# wheels\r\n" + line(1, 0.3) + "\n" + line(2, 0.2) + line(3, 0.1);
  for (const char byte : text) {
    client.send(std::string(1, byte));
    if (byte == ' ') sensor.doProcess();
  }
  EXPECT_EQ(take(3), (Positions{1, 2, 3}));
  EXPECT_EQ(sensor.counts().taken, 3u);
  EXPECT_EQ(sensor.leftOut(), 0u);
  EXPECT_EQ(sensor.leftOutByReason(), "");
}

TEST_F(OdometryLinesTest, invalidLinesAreCountedByReason) {
  open();
  Client client(sensor.port());
  client.send(line(1, 1) + "rubbish\n" + "- nan 0 0\n" + "- 0 1e9 0\n" + std::string(300, '7') + "\n" + line(2, 3600) +
              line(3, 1.5) + std::string("\x00\xff\x80 \x01\n", 6) + line(4, 0.5));
  EXPECT_EQ(take(2), (Positions{1, 4}));
  const auto counts = sensor.counts();
  EXPECT_EQ(counts.malformed, 2u);
  EXPECT_EQ(counts.not_finite, 1u);
  EXPECT_EQ(counts.too_large, 1u);
  EXPECT_EQ(counts.too_long, 1u);
  EXPECT_EQ(counts.wrong_clock, 1u);
  EXPECT_EQ(counts.not_newer, 1u);
  EXPECT_EQ(counts.leftOut(), 7u);
  EXPECT_NE(sensor.leftOutByReason().find("2 malformed, 1 with a value that is no finite number"), std::string::npos)
      << sensor.leftOutByReason();
  EXPECT_NE(sensor.leftOutByReason().find("(the first invalid line: rubbish)"), std::string::npos)
      << sensor.leftOutByReason();
}

TEST_F(OdometryLinesTest, aLineWithoutStampHasThatOfItsArrival) {
  open();
  Client client(sensor.port());
  const auto before = hostNow();
  client.send("- 1 2 3\n");
  sensor.doProcess();
  while (sensor.counts().taken == 0) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    sensor.doProcess();
  }
  const auto all = sensor.getObservations();
  ASSERT_EQ(all.size(), 1u);
  EXPECT_GE(all.begin()->first, before);
  EXPECT_LE(all.begin()->first, hostNow());
}

// The times of their measurement are unknown, and with stamps some microseconds apart the robot would seem to leap.
TEST_F(OdometryLinesTest, ofLinesWithoutStampsThatArriveTogetherTheLastOneCounts) {
  for (const char* protocol : {"tcp", "udp"}) {
    open(std::string("protocol = ") + protocol + "\n");
    Client client(sensor.port(), protocol == std::string("tcp") ? SOCK_STREAM : SOCK_DGRAM);
    const auto before = sensor.counts().superseded;
    client.send("- 1 0 0\n- 2 0 0\nrubbish\n- 3 0 0\n");
    EXPECT_EQ(take(1), (Positions{3})) << protocol;
    client.send("- 4 0 0\n" + line(5, -2) + "- 6 0 0\n");
    EXPECT_EQ(take(2), (Positions{4, 5})) << protocol << ": lines with stamps count each, and 6 is older than 5";
    EXPECT_EQ(sensor.counts().superseded - before, 2u) << protocol;
  }
  EXPECT_EQ(sensor.counts().leftOut(), 4u) << "malformed and not newer alone: " << sensor.leftOutByReason();
}

TEST_F(OdometryLinesTest, aLineWithoutEndIsNotKept) {
  open();
  Client client(sensor.port());
  const std::string endless(1 << 16, '1');
  std::size_t sent = 0;
  for (int i = 0; i < 300; ++i) {
    sent += client.send(endless);
    sensor.doProcess();
  }
  EXPECT_GT(sent, std::size_t{4} << 20);
  EXPECT_EQ(sensor.counts().too_long, 1u);
  client.send("\n" + line(1));
  EXPECT_EQ(sensor.counts().malformed, 0u);
}

// The rate counts, not the reader: as many lines as in a second at once, and then as many as time has passed.
TEST_F(OdometryLinesTest, aFloodIsLeftOutBeyondTheRate) {
  open("max_rate_hz = 100\n");
  Client client(sensor.port());
  std::string text;
  for (int i = 0; i < 5000; ++i) text += "- " + std::to_string(i) + " 0 0\n";
  const auto begin = std::chrono::steady_clock::now();
  std::size_t sent = 0;
  for (int i = 0; i < 200 && sent < text.size(); ++i) {
    sent += client.send(text.substr(sent));
    sensor.doProcess();
  }
  ASSERT_EQ(sent, text.size());
  take();
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  const auto counts = sensor.counts();
  EXPECT_GE(counts.taken + counts.superseded, 100u);
  EXPECT_LE(counts.taken + counts.superseded, 100u + static_cast<std::uint64_t>(100 * seconds) + 1);
  EXPECT_EQ(counts.taken + counts.superseded + counts.too_many, 5000u);
}

TEST_F(OdometryLinesTest, whatNobodyFetchesIsBounded) {
  open("max_rate_hz = 100000\n");
  Client client(sensor.port());
  const auto start = hostNow() - base::durationFromSeconds(5);
  std::string text;
  for (int i = 0; i < 25'000; ++i)
    text += base::formatUnix(start + base::durationFromSeconds(1e-4 * i)) + " " + std::to_string(i) + " 0 0\n";
  for (std::size_t sent = 0, i = 0; i < 3000 && sent < text.size(); ++i) {
    sent += client.send(text.substr(sent));
    sensor.doProcess();
  }
  for (int i = 0; i < 100; ++i) sensor.doProcess();
  const auto counts = sensor.counts();
  EXPECT_EQ(counts.taken, 25'000u);
  EXPECT_EQ(counts.never_fetched + sensor.getObservations().size(), 25'000u);
  EXPECT_GE(counts.never_fetched, 10'000u);
}

TEST_F(OdometryLinesTest, theClientThatConnectedLastCounts) {
  open();
  Client first(sensor.port());
  first.send(line(1, 0.2));
  EXPECT_EQ(take(1), (Positions{1}));
  first.send("- 5");
  take();
  Client second(sensor.port());
  second.send(line(2, 0.3));  // its clock is another's: older than the first's is no fault
  EXPECT_EQ(take(1), (Positions{2}));
  EXPECT_TRUE(first.wasClosed());
  EXPECT_EQ(sensor.counts().clients, 2u);
  EXPECT_EQ(sensor.counts().cut_off, 1u);
  second.close();
  take();
  Client third(sensor.port());
  third.send(line(3));
  EXPECT_EQ(take(1), (Positions{3}));
}

TEST_F(OdometryLinesTest, manyWhoConnectAtOnceDoNoHarm) {
  open();
  std::vector<std::unique_ptr<Client>> crowd;
  for (int i = 0; i < 200; ++i) {
    crowd.push_back(std::make_unique<Client>(sensor.port()));
    sensor.doProcess();
  }
  take();
  Client client(sensor.port());
  client.send(line(7));
  EXPECT_EQ(take(1), (Positions{7}));
}

TEST_F(OdometryLinesTest, datagramsHoldWholeLines) {
  open("protocol = udp\n");
  Client client(sensor.port(), SOCK_DGRAM), other(sensor.port(), SOCK_DGRAM);
  client.send(line(1, 0.3) + line(2, 0.2));
  std::string without_end = line(3, 0.1);
  without_end.pop_back();
  client.send(without_end);
  EXPECT_EQ(take(3), (Positions{1, 2, 3}));
  other.send(line(9));
  client.send("");
  client.send(std::string(60'000, '5'));
  client.send(line(4));
  EXPECT_EQ(take(1), (Positions{4}));
  EXPECT_EQ(sensor.counts().other_sender, 1u);
  EXPECT_EQ(sensor.counts().too_long, 1u);
  std::this_thread::sleep_for(std::chrono::milliseconds(1100));
  other.send(line(5));
  EXPECT_EQ(take(1), (Positions{5})) << "the first sender is silent";
}

/// The address at which a socket listens.
std::string boundIp(const std::string& bind) {
  const auto socket = bind.empty() ? listenTcp({}) : listenTcp({bind, 0});
  sockaddr_in system{};
  socklen_t size = sizeof system;
  getsockname(socket.get(), reinterpret_cast<sockaddr*>(&system), &size);
  char text[INET_ADDRSTRLEN];
  return inet_ntop(AF_INET, &system.sin_addr, text, sizeof text);
}

TEST_F(OdometryLinesTest, itListensOnlyForThisMachineByDefault) {
  EXPECT_EQ(OdometryLinesOptions().bind, "127.0.0.1");
  EXPECT_EQ(boundIp(""), "127.0.0.1");
  EXPECT_EQ(boundIp("0.0.0.0"), "0.0.0.0");
  EXPECT_EQ(boundIp("127.0.0.2"), "127.0.0.2");
}

TEST_F(OdometryLinesTest, whatIsWrongIsNamed) {
  const auto problemOf = [&](const std::string& keys) -> std::string {
    try {
      open(keys);
    } catch (const std::exception& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_NE(problemOf("bind = localhost\n").find("is no IPv4 address"), std::string::npos);
  EXPECT_NE(problemOf("port = 70000\n").find("port"), std::string::npos);
  EXPECT_NE(problemOf("protocol = tpc\n").find("tcp | udp"), std::string::npos);
  EXPECT_NE(problemOf("max_rate = 50\n").find("has no key 'max_rate'; did you mean max_rate_hz?"), std::string::npos)
      << problemOf("max_rate = 50\n");
  const auto taken = listenTcp({});
  EXPECT_NE(problemOf("port = " + std::to_string(boundPort(taken)) + "\n").find("another program uses this port"),
            std::string::npos);
  EXPECT_EQ(sensor.getState(), mrpt::hwdrivers::CGenericSensor::ssError);
}

// The page's table has a row for each key, with its default.
TEST(OdometryLinesOptions, thePageHasThemAll) {
  std::ifstream file(testing::sourceFile("doc/live.md"));
  const std::string page((std::istreambuf_iterator<char>(file)), {});
  for (const auto& spec : OdometryLinesOptions::table().specs()) {
    const auto row = page.find("| `" + spec.key + "` | ");
    ASSERT_NE(row, std::string::npos) << spec.key;
    const auto value = page.find("| ", row + 3 + spec.key.size()) + 2;
    const std::string quoted = "`" + spec.default_value + "` |", plain = spec.default_value + " |";
    EXPECT_TRUE(page.compare(value, quoted.size(), quoted) == 0 || page.compare(value, plain.size(), plain) == 0)
        << spec.key << ": " << page.substr(value, 20);
  }
}

TEST(OdometryLinesOptions, aMisspeltKeyEndsTheRun) {
  const auto config = base::Config::fromText(
      "[live]\nsensors = wheels\n[wheels]\ndriver = COdometryLines\nmax_rate = 50\n", "robot.ini");
  try {
    makeDriver(readSensors(config.section("live").read<LiveOptions>(), config).at(0));
    ADD_FAILURE();
  } catch (const base::Error& error) {
    EXPECT_EQ(error.code(), base::ExitCode::unknown_key) << error.what();
    EXPECT_NE(std::string(error.what()).find("sensor [wheels]: has no key 'max_rate'"), std::string::npos)
        << error.what();
  }
}

/// Tests through a LiveSource, at a free port.
class LiveOdometryTest : public ::testing::Test {
 protected:
  void SetUp() override {
    options.sensors = {"wheels"};
    options.silent_after = 0.1;
    options.reopen_after = 0.2;
    const auto config = base::Config::fromText(
        "[live]\nsensors = wheels\n[wheels]\ndriver = COdometryLines\nport = " + std::to_string(port) + "\n",
        "robot.ini");
    source = std::make_unique<LiveSource>(readSensors(options, config), options, nullptr);
    source->open({});
  }
  // The positions of the next observations: `count` of them, or fewer if none comes for 3 s.
  std::vector<double> take(std::size_t count) {
    std::vector<double> all;
    while (all.size() < count) {
      const auto next = source->next(std::chrono::seconds(3));
      if (!next) break;
      all.push_back(dynamic_cast<const CObservationOdometry&>(*next->observation).odometry.x());
    }
    return all;
  }
  std::string news() {
    std::string all;
    for (const auto& sentence : source->takeNews()) all += sentence + "\n";
    return all;
  }

  const std::uint16_t port = boundPort(listenTcp({}));
  LiveOptions options;
  std::unique_ptr<LiveSource> source;
};

TEST_F(LiveOdometryTest, aProgramThatSaysNothingForLongStaysConnected) {
  Client client(port);
  client.send("- 1 0 0\n");
  EXPECT_EQ(take(1), (Positions{1}));
  std::this_thread::sleep_for(std::chrono::milliseconds(500));
  const auto silence = news();
  EXPECT_NE(silence.find("is silent"), std::string::npos) << silence;
  EXPECT_EQ(silence.find("is lost"), std::string::npos) << silence;
  EXPECT_FALSE(client.wasClosed());
  client.send("- 2 0 0\n");
  EXPECT_EQ(take(1), (Positions{2}));
  std::string back;  // the observation may come before the news
  while (back.find("is back") == std::string::npos) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    back += news();
  }
}

TEST_F(LiveOdometryTest, rejectedLinesAreReportedOnceAndThenByTwos) {
  Client client(port);
  std::string all;
  for (int i = 0; i < 100; ++i) {
    client.send("- x 0 0\n- " + std::to_string(i) + " 0 0\n");
    take(1);
    all += news();
  }
  EXPECT_NE(all.find("which was discarded: 1 malformed"), std::string::npos) << all;
  const auto sentences = std::count(all.begin(), all.end(), '\n');
  EXPECT_GE(sentences, 4) << all;
  EXPECT_LE(sentences, 7) << "1, 2, 4, ... 64\n" << all;
  EXPECT_EQ(source->sensors().at(0).left_out, 100u);
}

// Runs the example of doc/live.md, with another port.
TEST_F(LiveOdometryTest, theExampleInPythonSendsOdometry) {
  if (std::system("python3 -c 0 2> /dev/null") != 0) GTEST_SKIP() << "python3 is not on this machine";
  std::ifstream file(testing::sourceFile("doc/live.md"));
  std::string page((std::istreambuf_iterator<char>(file)), {});
  const std::string fence = "```python\n", kPort = "7700";
  const auto begin = page.find(fence) + fence.size();
  std::string script = page.substr(begin, page.find("```", begin) - begin);
  ASSERT_NE(script.find(kPort), std::string::npos) << script;
  script.replace(script.find(kPort), kPort.size(), std::to_string(port));
  testing::Program robot({"python3", "-c", script});
  const auto positions = take(5);
  ASSERT_EQ(positions.size(), 5u) << testing::toString(robot.wait());
  EXPECT_LT(positions[0], 0.2);
  EXPECT_GT(positions[4], positions[0]);
  robot.send(SIGKILL);
}

}  // namespace
}  // namespace omnimapper::drivers::odometry_lines_test
