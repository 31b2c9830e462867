#include <omnimapper/base/Error.h>

#include <opencv2/core.hpp>
#include <opencv2/core/utils/logger.hpp>
#include <opencv2/dnn.hpp>

#include "Session.h"

namespace omnimapper::net {

namespace {

class OpenCvSession : public Session {
 public:
  explicit OpenCvSession(const std::string& path) : path_(path) {
    // OpenCV would print errors to the terminal, although the exceptions contain them.
    cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
    cv::setNumThreads(1);
    try {
      net_ = cv::dnn::readNetFromONNX(path);
      net_.setPreferableBackend(cv::dnn::DNN_BACKEND_OPENCV);
      outputs_ = net_.getUnconnectedOutLayersNames();
    } catch (const cv::Exception& error) {
      refuse("OpenCV cannot read it (" + asOneLine(error.err) + "); scripts/models converts networks for OpenCV");
    }
    if (outputs_.size() != 1) refuse("it has " + std::to_string(outputs_.size()) + " outputs, and should have one");
  }

  Tensor run(const Tensor& input) override {
    try {
      const cv::Mat values(input.shape, CV_32F, const_cast<float*>(input.values.data()));
      net_.setInput(values);
      const cv::Mat output = net_.forward(outputs_.front());
      Tensor result;
      for (int axis = 0; axis < output.dims; ++axis) result.shape.push_back(output.size[axis]);
      const auto* begin = output.ptr<float>();
      result.values.assign(begin, begin + output.total());
      return result;
    } catch (const cv::Exception& error) {
      refuse("OpenCV cannot compute it for this input: " + asOneLine(error.err));
    }
  }

 private:
  [[noreturn]] void refuse(const std::string& why) const {
    throw base::Error(base::ExitCode::unreadable_input, path_ + ": " + why);
  }

  std::string path_;
  cv::dnn::Net net_;
  std::vector<cv::String> outputs_;
};

}  // namespace

std::unique_ptr<Session> openWithOpenCv(const std::string& path) {
  return std::make_unique<OpenCvSession>(path);
}

}  // namespace omnimapper::net
