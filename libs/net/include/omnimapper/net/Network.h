#pragma once

#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace omnimapper::net {

/// An array of the given shape, with the last axis fastest. A batch of pictures is (pictures, channels, rows, columns).
struct Tensor {
  std::vector<int> shape;
  std::vector<float> values;
};

/// The library that computes a network.
enum class Backend {
  opencv,       ///< OpenCV's module dnn
  onnx_runtime  ///< Microsoft's ONNX Runtime, two to three times as fast; its library is loaded when it is needed
};

/// The folder where scripts/models puts networks and the library of ONNX Runtime: $XDG_DATA_HOME/omnimapper/models,
/// without that variable ~/.local/share/omnimapper/models.
std::string modelsFolder();

class Session;

/// A trained network with one input and one output, read from an ONNX file. It is computed only in the calling thread,
/// so that results do not depend on the number of cores; they may depend on the kind of processor. Thread-safe: threads
/// that call at the same time use different copies of the network, each of which is read from the file when it is first
/// needed.
class Network {
 public:
  /// Backend::opencv switches off OpenCV's threads and its log in the whole process. `library` is the file of ONNX
  /// Runtime; it is empty with another backend. Throws Error(unreadable_input), naming the network's file, if this file
  /// is missing, empty or no network, or if the network has several inputs or outputs. Throws Error(plugin_library) if
  /// the library cannot be loaded or is older than 1.11.
  Network(const std::string& path, Backend backend, const std::string& library = "");
  ~Network();

  /// Throws Error(unreadable_input) if `input` is not of a shape that the network takes.
  Tensor run(const Tensor& input) const;

  const std::string& path() const { return path_; }

 private:
  std::unique_ptr<Session> take() const;

  std::string path_;
  Backend backend_;
  std::string library_;
  mutable std::mutex mutex_;
  mutable std::vector<std::unique_ptr<Session>> idle_;
};

}  // namespace omnimapper::net
