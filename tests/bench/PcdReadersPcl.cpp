#include <omnimapper/testing/Fixtures.h>
#include <pcl/io/pcd_io.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <functional>
#include <iterator>
#include <random>
#include <string>

#include "PcdReaders.h"
#include "pcd_folder/PcdCloud.h"

namespace omnimapper::bench {

namespace {

using Cloud = pcl::PointCloud<pcl::PointXYZRGB>;
using Reader = std::function<bool(const std::string&)>;

bool readOurs(const std::string& path) {
  try {
    source::readPcd(path);
    return true;
  } catch (const std::exception&) {
    return false;
  }
}

bool readPcl(const std::string& path) {
  try {
    pcl::PCLPointCloud2 cloud;
    Eigen::Vector4f origin;
    Eigen::Quaternionf orientation;
    int version = 0;
    return pcl::PCDReader().read(path, cloud, origin, orientation, version) >= 0;
  } catch (const std::exception&) {
    return false;
  }
}

Cloud randomCloud(unsigned width, unsigned height) {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> place(-3, 3);
  Cloud cloud(width, height);
  for (auto& point : cloud.points) point.getVector3fMap() << place(random), place(random), place(random);
  return cloud;
}

std::string contentsOf(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

// Changes or removes bytes at one to four places, half of them in the header, and truncates every fifth file.
std::string damaged(std::string text, std::mt19937& random) {
  constexpr std::size_t kHeader = 260;
  const std::string likely = "0123456789- xF";
  for (auto changes = 1 + random() % 4; changes > 0 && !text.empty(); --changes) {
    const std::size_t at = random() % (random() % 2 == 0 ? text.size() : std::min(text.size(), kHeader));
    switch (random() % 3) {
      case 0:
        text[at] = static_cast<char>(random());
        break;
      case 1:
        text[at] = likely[random() % likely.size()];
        break;
      default:
        text.erase(at, 1 + random() % 3);
    }
  }
  if (random() % 5 == 0) text.resize(random() % (text.size() + 1));
  return text;
}

// Whether the reader leaves the process alive. It runs in a child process with 4 GB of memory and ten seconds.
bool survives(const Reader& reader, const std::string& path) {
  std::fflush(nullptr);
  const pid_t child = fork();
  if (child == 0) {
    const rlimit memory{std::size_t{4} << 30, std::size_t{4} << 30};
    setrlimit(RLIMIT_AS, &memory);
    alarm(10);
    if (!std::freopen("/dev/null", "w", stderr)) _exit(1);
    _exit(reader(path) ? 0 : 1);
  }
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status);
}

}  // namespace

void comparePcdReaders() {
  const testing::ScratchFolder folder;
  const auto path = [&](const std::string& name) { return folder / name; };
  const auto small = randomCloud(40, 30);
  pcl::io::savePCDFileASCII(path("text.pcd"), small);
  pcl::io::savePCDFileBinary(path("binary.pcd"), small);
  pcl::io::savePCDFileBinaryCompressed(path("compressed.pcd"), small);
  pcl::io::savePCDFileBinaryCompressed(path("whole.pcd"), randomCloud(640, 480));
  constexpr int kFiles = 1500, kReads = 20;
  const std::pair<const char*, Reader> readers[] = {{"ours", readOurs}, {"PCL's", readPcl}};
  std::printf(
      "\n| reader | of %d damaged files ended the process: text | binary | compressed | 640 x 480, compressed [ms] "
      "|\n|---|---|---|---|---|\n",
      kFiles);
  for (const auto& [name, reader] : readers) {
    std::printf("| %s |", name);
    for (const std::string form : {"text.pcd", "binary.pcd", "compressed.pcd"}) {
      const std::string whole = contentsOf(path(form));
      std::mt19937 random(7);
      int ended = 0;
      for (int i = 0; i < kFiles; ++i) {
        std::ofstream(path("damaged.pcd"), std::ios::binary) << damaged(whole, random);
        ended += survives(reader, path("damaged.pcd")) ? 0 : 1;
      }
      std::printf(" %d |", ended);
    }
    const auto begin = std::chrono::steady_clock::now();
    for (int i = 0; i < kReads; ++i) reader(path("whole.pcd"));
    const std::chrono::duration<double, std::milli> spent = std::chrono::steady_clock::now() - begin;
    std::printf(" %.1f |\n", spent.count() / kReads);
  }
}

}  // namespace omnimapper::bench
