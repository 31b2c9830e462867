#include <gtest/gtest.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/net/Network.h>
#include <omnimapper/testing/Fixtures.h>
#include <omnimapper/testing/OnnxBytes.h>

#include <filesystem>
#include <fstream>
#include <thread>

namespace omnimapper::net {
namespace {

namespace fs = std::filesystem;

// Of each pixel's two channels a and b: a + 2 b and 3 a - b, then what is positive.
std::string smallModel() {
  using namespace testing::onnx_bytes;
  return model({node("Conv", {"picture", "weights"}, "mixed", {attribute("kernel_shape", {1, 1})}),
                node("Relu", {"mixed"}, "positive")},
               {weights("weights", {2, 2, 1, 1}, {1, 2, 3, -1})}, {value("picture", {1, 2, 1, 3})},
               {value("positive", {1, 2, 1, 3})});
}

const Tensor kPicture = {{1, 2, 1, 3}, {1, 0, -1, 5, 1, 2}};
const std::vector<float> kAnswer = {11, 2, 3, 0, 0, 0};

class NetworkTest : public ::testing::TestWithParam<Backend> {
 protected:
  void SetUp() override {
    if (GetParam() == Backend::opencv) return;
    library_ = modelsFolder() + "/libonnxruntime.so.1";
    if (!fs::exists(library_)) GTEST_SKIP() << "ONNX Runtime is not there: scripts/models --onnxruntime fetches it";
  }
  Network read(const std::string& path) const { return Network(path, GetParam(), library_); }
  std::string write(const std::string& bytes) const {
    std::ofstream(folder_ / "model.onnx", std::ios::binary) << bytes;
    return folder_ / "model.onnx";
  }

  testing::ScratchFolder folder_;
  std::string library_;
};

TEST_P(NetworkTest, computesByHandWorkedNumbers) {
  const auto network = read(write(smallModel()));
  for (int round = 0; round < 2; ++round) {
    const auto answer = network.run(kPicture);
    EXPECT_EQ(answer.shape, kPicture.shape);
    EXPECT_EQ(answer.values, kAnswer);
  }
}

TEST_P(NetworkTest, threadsMayAskAtOnce) {
  const auto network = read(write(smallModel()));
  std::vector<std::vector<float>> answers(4);
  std::vector<std::thread> threads;
  for (auto& answer : answers) {
    threads.emplace_back([&network, &answer] {
      for (int round = 0; round < 50; ++round) answer = network.run(kPicture).values;
    });
  }
  for (auto& thread : threads) thread.join();
  EXPECT_EQ(answers, std::vector<std::vector<float>>(4, kAnswer));
}

TEST_P(NetworkTest, filesThatAreNoNetworksAreRefusedByName) {
  const auto whole = smallModel();
  using namespace testing::onnx_bytes;
  const std::string two_outputs =
      model({node("Relu", {"x"}, "y"), node("Sigmoid", {"x"}, "z")}, {}, {value("x", {1, 1, 1, 3})},
            {value("y", {1, 1, 1, 3}), value("z", {1, 1, 1, 3})});
  for (const auto& bytes : {std::string(), std::string("no network"), whole.substr(0, whole.size() / 2), two_outputs,
                            model({node("Teleport", {"x"}, "y")}, {}, {value("x", {1, 3})}, {value("y", {1, 3})})}) {
    const auto path = write(bytes);
    try {
      read(path);
      ADD_FAILURE() << "taken: " << bytes.size() << " bytes";
    } catch (const base::Error& error) {
      EXPECT_EQ(error.code(), base::ExitCode::unreadable_input) << error.what();
      EXPECT_NE(std::string(error.what()).find(path), std::string::npos) << error.what();
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
    }
  }
  EXPECT_THROW(read(folder_ / "missing.onnx"), base::Error);
  EXPECT_THROW(read("/"), base::Error);
}

TEST_P(NetworkTest, picturesOfAnotherShapeAreRefused) {
  const auto network = read(write(smallModel()));
  EXPECT_THROW(network.run({{1, 3, 1, 2}, std::vector<float>(6)}), base::Error);
  EXPECT_EQ(network.run(kPicture).values, kAnswer) << "afterwards it computes as before";
}

INSTANTIATE_TEST_SUITE_P(Backends, NetworkTest, ::testing::Values(Backend::opencv, Backend::onnx_runtime),
                         [](const auto& info) { return info.param == Backend::opencv ? "opencv" : "onnx_runtime"; });

// The system's loader ends a program over a library whose end is missing.
TEST(Network, aLibraryThatIsCutOffIsRefused) {
  const testing::ScratchFolder folder;
  std::ofstream(folder / "model.onnx", std::ios::binary) << smallModel();
  const std::string cut = folder / "libcut.so";
  std::ifstream self("/proc/self/exe", std::ios::binary);  // an ELF file, too
  std::string begin(100000, '\0');
  self.read(begin.data(), static_cast<std::streamsize>(begin.size()));
  std::ofstream(cut, std::ios::binary) << begin;
  try {
    Network(folder / "model.onnx", Backend::onnx_runtime, cut);
    FAIL();
  } catch (const base::Error& error) {
    EXPECT_EQ(error.code(), base::ExitCode::plugin_library);
    EXPECT_NE(std::string(error.what()).find("cut off"), std::string::npos) << error.what();
  }
}

TEST(Network, aLibraryThatIsNotOnnxRuntimeIsRefusedByName) {
  const testing::ScratchFolder folder;
  std::ofstream(folder / "model.onnx", std::ios::binary) << smallModel();
  for (const auto& library : {std::string(folder / "missing.so"), std::string("libm.so.6")}) {
    try {
      Network(folder / "model.onnx", Backend::onnx_runtime, library);
      ADD_FAILURE() << library;
    } catch (const base::Error& error) {
      EXPECT_EQ(error.code(), base::ExitCode::plugin_library);
      EXPECT_EQ(std::string(error.what()).find(library), 0u) << error.what();
    }
  }
}

}  // namespace
}  // namespace omnimapper::net
