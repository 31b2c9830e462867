#include <dlfcn.h>
#include <omnimapper/base/Error.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <type_traits>

#include "Session.h"

// ONNX Runtime's C interface is a table of functions that only grows (onnxruntime_c_api.h: "New functions must be added
// only at the end"). Debian 12 has no header for it, so the indices of the functions that are used are listed here.

namespace omnimapper::net {

namespace {

using Table = const void* const*;

struct ApiBase {
  Table (*table)(std::uint32_t version);
  const char* (*version)();
};

constexpr std::uint32_t kVersion = 11;  // of ONNX Runtime 1.11
constexpr int kWarnings = 2, kFloat = 1, kDeviceAllocator = 0, kDefaultMemory = 0;

enum Function {
  error_message = 2,
  create_environment = 3,
  create_session = 7,
  run_session = 9,
  create_options = 10,
  set_threads_in_node = 24,
  set_threads_of_graph = 25,
  count_inputs = 30,
  count_outputs = 31,
  input_name = 36,
  output_name = 37,
  create_tensor = 49,
  tensor_data = 51,
  count_dimensions = 61,
  dimensions = 62,
  count_elements = 64,
  tensor_shape = 65,
  create_memory_info = 69,
  free_name = 76,
  default_allocator = 78,
  release_environment = 92,
  release_status = 93,
  release_memory_info = 94,
  release_session = 95,
  release_value = 96,
  release_shape = 99,
  release_options = 100
};

class Api {
 public:
  Api(Table table, std::string path) : table_(table), path_(std::move(path)) {}

  // Calls a function that may fail.
  template <class... Arguments>
  void operator()(Function function, Arguments... arguments) const {
    void* status = reinterpret_cast<void* (*)(Arguments...)>(at(function))(arguments...);
    if (status == nullptr) return;
    const std::string message = reinterpret_cast<const char* (*)(const void*)>(at(error_message))(status);
    release(release_status, status);
    throw base::Error(base::ExitCode::unreadable_input, path_ + ": ONNX Runtime refuses it: " + asOneLine(message));
  }
  void release(Function function, void* object) const {
    if (object != nullptr) reinterpret_cast<void (*)(void*)>(at(function))(object);
  }
  const std::string& path() const { return path_; }

 private:
  void* at(Function function) const { return const_cast<void*>(table_[function]); }

  Table table_;
  std::string path_;
};

// An object of the library that is released with this one.
class Handle {
 public:
  Handle(const Api& api, Function release) : api_(api), release_(release) {}
  ~Handle() { api_.release(release_, object_); }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  void* get() const { return object_; }
  void** out() { return &object_; }

 private:
  const Api& api_;
  Function release_;
  void* object_ = nullptr;
};

// Whether a shared library (ELF, 64 bits) ends before the table of its sections, which is its last part.
bool isCutOff(const std::string& library) {
  constexpr std::size_t kHeader = 64, kOffset = 40, kSize = 58, kCount = 60;
  std::ifstream file(library, std::ios::binary);
  char header[kHeader] = {};
  if (!file.read(header, kHeader) || std::memcmp(header,
                                                 "\x7f"
                                                 "ELF",
                                                 4) != 0)
    return false;  // the loader reports what it is
  std::uint64_t offset = 0;
  std::uint16_t size = 0, count = 0;
  std::memcpy(&offset, header + kOffset, sizeof offset);
  std::memcpy(&size, header + kSize, sizeof size);
  std::memcpy(&count, header + kCount, sizeof count);
  file.seekg(0, std::ios::end);
  return static_cast<std::uint64_t>(file.tellg()) < offset + std::uint64_t{size} * count;
}

// The library stays loaded until the program ends.
Table loadTable(const std::string& library) {
  const auto refuse = [&](const std::string& why) {
    throw base::Error(base::ExitCode::plugin_library, library + ": ONNX Runtime cannot be loaded (" + why +
                                                          "); scripts/models --onnxruntime fetches it");
  };
  // The system's loader would crash the program on a file that is shorter than its header says.
  if (isCutOff(library)) refuse("it is cut off");
  void* handle = dlopen(library.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (handle == nullptr) refuse(dlerror());
  const auto base = reinterpret_cast<const ApiBase* (*)()>(dlsym(handle, "OrtGetApiBase"));
  if (base == nullptr) refuse("it has no OrtGetApiBase");
  if (base() == nullptr) refuse("it provides no functions");
  const Table table = base()->table(kVersion);
  if (table == nullptr) refuse(std::string("version 1.11 or later is needed, and this is ") + base()->version());
  return table;
}

class OnnxRuntimeSession : public Session {
 public:
  OnnxRuntimeSession(const std::string& path, const std::string& library) : api_(loadTable(library), path) {
    api_(create_environment, kWarnings, "omnimapper", environment_.out());
    Handle options(api_, release_options);
    api_(create_options, options.out());
    api_(set_threads_in_node, options.get(), 1);
    api_(set_threads_of_graph, options.get(), 1);
    api_(create_session, environment_.get(), path.c_str(), static_cast<const void*>(options.get()), session_.out());
    api_(create_memory_info, kDeviceAllocator, kDefaultMemory, memory_.out());
    input_ = onlyName(count_inputs, input_name, "inputs");
    output_ = onlyName(count_outputs, output_name, "outputs");
  }

  Tensor run(const Tensor& input) override {
    const std::vector<std::int64_t> shape(input.shape.begin(), input.shape.end());
    Handle in(api_, release_value), out(api_, release_value);
    api_(create_tensor, static_cast<const void*>(memory_.get()), static_cast<const void*>(input.values.data()),
         input.values.size() * sizeof(float), shape.data(), shape.size(), kFloat, in.out());
    const char* const inputs[] = {input_.c_str()};
    const char* const outputs[] = {output_.c_str()};
    const void* const values[] = {in.get()};
    api_(run_session, session_.get(), static_cast<const void*>(nullptr), inputs, values, std::size_t{1}, outputs,
         std::size_t{1}, out.out());
    return tensorOf(out.get());
  }

 private:
  std::string onlyName(Function count, Function name, const char* what) const {
    std::size_t number = 0;
    api_(count, static_cast<const void*>(session_.get()), &number);
    if (number != 1) {
      throw base::Error(base::ExitCode::unreadable_input,
                        api_.path() + ": it has " + std::to_string(number) + " " + what + ", and should have one");
    }
    void* allocator = nullptr;
    api_(default_allocator, &allocator);
    char* text = nullptr;
    api_(name, static_cast<const void*>(session_.get()), std::size_t{0}, allocator, &text);
    std::string result = text;
    api_(free_name, allocator, static_cast<void*>(text));
    return result;
  }

  Tensor tensorOf(void* value) const {
    Handle shape(api_, release_shape);
    api_(tensor_shape, static_cast<const void*>(value), shape.out());
    std::size_t axes = 0, size = 0;
    api_(count_dimensions, static_cast<const void*>(shape.get()), &axes);
    api_(count_elements, static_cast<const void*>(shape.get()), &size);
    std::vector<std::int64_t> sizes(axes);
    api_(dimensions, static_cast<const void*>(shape.get()), sizes.data(), axes);
    float* data = nullptr;
    api_(tensor_data, value, reinterpret_cast<void**>(&data));
    return {{sizes.begin(), sizes.end()}, {data, data + size}};
  }

  Api api_;
  Handle environment_{api_, release_environment}, session_{api_, release_session}, memory_{api_, release_memory_info};
  std::string input_, output_;
};

}  // namespace

std::unique_ptr<Session> openWithOnnxRuntime(const std::string& path, const std::string& library) {
  return std::make_unique<OnnxRuntimeSession>(path, library);
}

}  // namespace omnimapper::net
