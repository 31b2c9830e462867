#include "FuzzedRuns.h"

#include <mrpt/img/CImage.h>
#include <omnimapper/testing/Fixtures.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>

#include "FileMutation.h"
#include "IniKeys.h"

namespace omnimapper::fuzz {

namespace fs = std::filesystem;

namespace {

std::string contentOf(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

void write(const fs::path& path, const std::string& bytes) {
  fs::create_directories(path.parent_path());
  std::ofstream out(path, std::ios::binary);
  if (!(out << bytes).flush()) throw std::runtime_error("cannot write " + path.string());
}

void expectWell(const std::vector<std::string>& command) {
  const auto ended = testing::runProgram(command);
  if (ended.code != 0) throw std::runtime_error(command.front() + " with valid input " + toString(ended));
}

// Writes three depth images of a slope and their colour images, in the layout of the TUM benchmark.
void writeImages(const fs::path& folder) {
  constexpr int kWidth = 160, kHeight = 120;
  std::string depths, colours, poses;
  for (int n = 0; n < 3; ++n) {
    mrpt::img::CImage depth, colour(kWidth, kHeight, mrpt::img::CH_RGB);
    depth.resize(kWidth, kHeight, mrpt::img::CH_GRAY, mrpt::img::PixelDepth::D16U);
    for (unsigned y = 0; y < kHeight; ++y) {
      for (unsigned x = 0; x < kWidth; ++x)
        depth.ptrLine<std::uint16_t>(y)[x] = static_cast<std::uint16_t>(8000 + 20 * y + 3 * x);
    }
    colour.filledRectangle(0, 0, kWidth - 1, kHeight - 1, mrpt::img::TColor(200, 30, 20));
    const std::string number = std::to_string(n);
    for (const char* kind : {"depth", "rgb"}) fs::create_directories(folder / kind);
    if (!depth.saveToFile((folder / "depth" / (number + ".png")).string()) ||
        !colour.saveToFile((folder / "rgb" / (number + ".png")).string()))
      throw std::runtime_error("cannot write images into " + folder.string());
    depths += "10." + number + " depth/" + number + ".png\n";
    colours += "10." + number + " rgb/" + number + ".png\n";
    poses += "10." + number + " 0." + number + " 0 1 0 0 0 1\n";
  }
  write(folder / "depth.txt", depths);
  write(folder / "rgb.txt", colours);
  write(folder / "groundtruth.txt", poses);
  write(folder / "camera.txt", "fx = 130\nfy = 130\ncx = 80\ncy = 60\n");
}

void writeClouds(const fs::path& folder) {
  for (int n = 0; n < 2; ++n) {
    std::ostringstream cloud;
    cloud << "# .PCD v0.7\nVERSION 0.7\nFIELDS x y z rgb\nSIZE 4 4 4 4\nTYPE F F F U\nCOUNT 1 1 1 1\nWIDTH 32\nHEIGHT "
             "24\n"
          << "VIEWPOINT 0 0 0 1 0 0 0\nPOINTS 768\nDATA ascii\n";
    for (int y = 0; y < 24; ++y) {
      for (int x = 0; x < 32; ++x) cloud << 0.02 * (x - 16) << " " << 0.02 * (y - 12) << " 2 4294901760\n";
    }
    write(folder / ("cloud_" + std::to_string(n) + ".pcd"), cloud.str());
  }
}

void writeCarmen(const fs::path& file) {
  std::ostringstream log;
  log << "PARAM laser_front_laser_resolution 1.0\n";
  for (int n = 0; n < 20; ++n) {
    const double x = 0.1 * n;
    log << "ODOM " << x << " 0 0 0.1 0 0 " << 100 + x << " robot " << x << "\nFLASER 181";
    for (int beam = 0; beam < 181; ++beam) log << " " << 3 + 0.01 * beam;
    log << " " << x << " 0 0 " << x << " 0 0 " << 100.05 + x << " robot " << 0.05 + x << "\n";
  }
  write(file, log.str());
}

std::vector<fs::path> filesUnder(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file()) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

void mutateFile(const fs::path& file, Dice& dice) {
  auto bytes = contentOf(file);
  const auto kind = file.extension();
  if (kind == ".png") {
    bytes = mutatedPng(bytes, dice);
  } else if (kind == ".txt" || kind == ".pcd" || kind == ".clf") {
    bytes = mutatedText(bytes, dice);
  } else {
    damageBytes(bytes, dice);
  }
  if (onceIn(dice, 20)) bytes.resize(below(dice, bytes.size() + 1));
  write(file, bytes);
}

}  // namespace

FuzzedRuns::FuzzedRuns(Wrong wrong, const std::string& programs, const std::string& scratch)
    : wrong_(wrong), programs_(programs), scratch_(scratch), scenes_(scenes(programs, scratch)) {
  for (const auto& scene : scenes_) {
    logs_.push_back(scratch_ + "/" + std::to_string(logs_.size()) + ".rawlog");
    write(logs_.back(), bytesOf(scene.log));
    if (wrong != Wrong::maps || scene.program != "omnimapper-graphslam") continue;
    expectWell(command(scene, logs_.back(), scratch_ + "/map"));
    maps_.push_back({logs_.size() - 1, map::MapFile::read(scratch_ + "/map/map.omnimap")});
    fs::remove_all(scratch_ + "/map");
  }
  if (wrong != Wrong::folders) return;
  writeImages(scratch_ + "/images");
  writeClouds(scratch_ + "/clouds");
  writeCarmen(scratch_ + "/carmen/log.clf");
  fs::create_directories(scratch_ + "/external");
  expectWell({programs_ + "/omnimapper-import", "tum", scratch_ + "/images", scratch_ + "/external/log.rawlog",
              "--poses", "--images", "external", "--intrinsics", scratch_ + "/images/camera.txt"});
}

std::vector<std::string> FuzzedRuns::command(const Scene& scene, const std::string& log,
                                             const std::string& folder) const {
  const bool perceives = scene.program == "omnimapper-perceive";
  return {programs_ + "/" + scene.program, "-i", scene.ini, "-r", log, "-o", perceives ? folder + ".rawlog" : folder};
}

FuzzedRun FuzzedRuns::make(std::uint64_t number, const std::string& folder) const {
  fs::remove_all(folder);
  fs::create_directories(folder);
  Dice dice(number);
  switch (wrong_) {
    case Wrong::logs:
      return ofLog(dice, folder);
    case Wrong::maps:
      return ofMap(dice, folder);
    case Wrong::inis:
      return ofIni(dice, folder);
    case Wrong::folders:
      break;
  }
  return ofFolder(dice, folder);
}

FuzzedRun FuzzedRuns::ofLog(Dice& dice, const std::string& folder) const {
  const auto& scene = scenes_[below(dice, scenes_.size())];
  const std::string log = folder + "/log.rawlog";
  write(log, mutatedLog(scene.log, dice));
  if (onceIn(dice, 10)) return {"check", {programs_ + "/omnimapper-graphslam", "--check", log}};
  return {scene.name, command(scene, log, folder + "/out")};
}

FuzzedRun FuzzedRuns::ofMap(Dice& dice, const std::string& folder) const {
  const auto& made = maps_[below(dice, maps_.size())];
  const std::string file = folder + "/map.omnimap";
  mutatedMap(made.map, maps_[below(dice, maps_.size())].map, dice).write(file);
  const auto& scene = scenes_[made.scene];
  auto words = command(scene, logs_[made.scene], folder + "/out");
  words.insert(words.end(), {onceIn(dice, 2) ? "--continue" : "--localize", file});
  return {scene.name, words};
}

FuzzedRun FuzzedRuns::ofIni(Dice& dice, const std::string& folder) const {
  const std::size_t chosen = below(dice, scenes_.size());
  auto scene = scenes_[chosen];
  const auto keys = keysOf(scene.ini);
  std::vector<std::string> settings;
  if (onceIn(dice, 2)) {
    const std::size_t count = 1 + below(dice, 3);
    for (std::size_t i = 0; i < count; ++i) settings.push_back(oddSetting(keys[below(dice, keys.size())], dice));
  } else {
    const auto text = contentOf(scene.ini);
    scene.ini = folder + "/mutated.ini";
    write(scene.ini, mutatedText(text, dice));
  }
  auto words = command(scene, logs_[chosen], folder + "/out");
  for (const auto& setting : settings) words.insert(words.end(), {"--set", setting});
  return {scene.name, words};
}

FuzzedRun FuzzedRuns::ofFolder(Dice& dice, const std::string& folder) const {
  const char* const kinds[] = {"images", "clouds", "carmen", "external"};
  const std::string kind = kinds[below(dice, std::size(kinds))], input = folder + "/" + kind;
  fs::copy(scratch_ + "/" + kind, input, fs::copy_options::recursive);
  const auto files = filesUnder(input);
  const std::size_t count = 1 + below(dice, 3);
  for (std::size_t i = 0; i < count; ++i) mutateFile(files[below(dice, files.size())], dice);
  const std::string import = programs_ + "/omnimapper-import", log = folder + "/log.rawlog";
  if (kind == "clouds") return {kind, {import, "pcd", input, log}};
  if (kind == "carmen") return {kind, {import, "carmen", input + "/log.clf", log}};
  if (kind == "images") return {kind, {import, "tum", input, log, "--poses", "--intrinsics", input + "/camera.txt"}};
  return {kind,
          {programs_ + "/omnimapper-graphslam", "-i", testing::sourceFile("ini/rgbd_planes.ini"), "-r",
           input + "/log.rawlog", "-o", folder + "/out"}};
}

std::optional<std::string> complaint(const testing::Ended& ended, const Bounds& bounds) {
  if (!ended.in_time || ended.own_seconds > bounds.seconds) return "took " + std::to_string(ended.own_seconds) + " s";
  if (ended.signal != 0) return "signal " + std::to_string(ended.signal);
  const bool is_documented = ended.code == 0 || (ended.code >= 2 && ended.code <= 19);
  if (!is_documented) return "exit code " + std::to_string(ended.code);
  if (ended.peak_mib > bounds.mib) return "took " + std::to_string(ended.peak_mib) + " MiB";
  if (ended.code != 0 && ended.err.empty() && ended.out.empty()) return std::string("failed without a message");
  for (const auto* said : {&ended.out, &ended.err}) {
    if (said->find('\x1b') != std::string::npos) return std::string("wrote escape codes");
  }
  return std::nullopt;
}

}  // namespace omnimapper::fuzz
