#include "TruthFolder.h"

#include <omnimapper/base/AtomicFile.h>
#include <omnimapper/base/Error.h>

#include <filesystem>

namespace omnimapper::sim {

namespace fs = std::filesystem;

namespace {

void require(bool written, const std::string& path) {
  if (!written) throw base::Error(base::ExitCode::disk_full, path + ": cannot be written whole; is the disk full?");
}

}  // namespace

std::string TruthFolder::pathOf(const std::string& label) const {
  return folder_ + "/truth/" + label + ".jsonl";
}

void TruthFolder::add(const Sensor& sensor, int k, const Measurement& measurement) {
  if (!measurement.truth.empty()) {
    const std::string path = pathOf(sensor.label());
    auto [stream, is_new] = lines_.try_emplace(sensor.label());
    if (is_new) {
      base::makeWritableFolder(folder_ + "/truth");
      stream->second.open(path, std::ios::binary);
      if (!stream->second.is_open())
        throw base::Error(base::ExitCode::unwritable_output, path + ": cannot be made; may the folder be written?");
    }
    stream->second << "{\"measurement\":" << k << ",\"stamp\":" << base::formatUnix(sensor.stampOf(k))
                   << ",\"truth\":" << measurement.truth << "}\n";
    require(stream->second.good(), path);
  }
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
  for (auto& [label, stream] : lines_) {
    stream.close();
    require(stream.good(), pathOf(label));
    labels_.push_back(label);
  }
  lines_.clear();
}

std::vector<std::string> TruthFolder::files() const {
  std::vector<std::string> files;
  for (const auto& label : labels_) files.push_back("truth/" + label + ".jsonl");
  for (const auto& [folder, count] : folders_) files.push_back(folder);
  return files;
}

}  // namespace omnimapper::sim
