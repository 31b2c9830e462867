#include "TruthFolder.h"

#include <omnimapper/base/AtomicFile.h>
#include <omnimapper/base/Error.h>

#include <filesystem>

#include "sensors/PersonBeams.h"

namespace omnimapper::sim {

namespace fs = std::filesystem;

namespace {

void require(bool written, const std::string& path) {
  if (!written) throw base::Error(base::ExitCode::disk_full, path + ": cannot be written whole; is the disk full?");
}

}  // namespace

// Appends to a file, which begins with `first_line`.
void TruthFolder::addLine(const std::string& file, const std::string& first_line, const std::string& text) {
  const std::string path = folder_ + "/truth/" + file;
  auto [stream, is_new] = open_.try_emplace(file);
  if (is_new) {
    base::makeWritableFolder(folder_ + "/truth");
    stream->second.open(path, std::ios::binary);
    if (!stream->second.is_open())
      throw base::Error(base::ExitCode::unwritable_output, path + ": cannot be made; may the folder be written?");
    stream->second << first_line;
  }
  stream->second << text;
  require(stream->second.good(), path);
}

void TruthFolder::add(const Sensor& sensor, int k, const Measurement& measurement) {
  if (!measurement.truth.empty()) {
    addLine(sensor.label() + ".jsonl", "",
            "{\"measurement\":" + std::to_string(k) + ",\"stamp\":" + base::formatUnix(sensor.stampOf(k)) +
                ",\"truth\":" + measurement.truth + "}\n");
  }
  if (measurement.body_rows)
    addLine(sensor.label() + "_bodies.csv", std::string(kPersonBeamsColumns) + "\n", *measurement.body_rows);
  for (const TruthFile& file : measurement.truth_files) {
    const fs::path path = fs::path(folder_) / "truth" / file.name;
    const std::string parent = (fs::path("truth") / file.name).parent_path().string() + "/";
    if (folders_[parent]++ == 0) base::makeWritableFolder(path.parent_path().string());
    std::ofstream out(path, std::ios::binary);
    out << file.bytes;
    out.close();
    require(out.good(), path.string());
  }
}

void TruthFolder::close() {
  for (auto& [file, stream] : open_) {
    stream.close();
    require(stream.good(), folder_ + "/truth/" + file);
    closed_.push_back(file);
  }
  open_.clear();
}

std::vector<std::string> TruthFolder::files() const {
  std::vector<std::string> files;
  for (const auto& file : closed_) files.push_back("truth/" + file);
  for (const auto& [folder, count] : folders_) files.push_back(folder);
  return files;
}

}  // namespace omnimapper::sim
