#include "PlateOutlines.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace omnimapper::signs {

namespace {

using Eigen::Vector2f;

constexpr float kHeight = 16;     // [px] height of the text in the upright patch in which edges are sought
constexpr float kReach = 7;       // how far the patch reaches beyond the text, in heights of the text
constexpr float kFullEdge = 6;    // change of colour per pixel (CIELAB, lightness 0 to 255) that counts as a full edge
constexpr float kBeyondText = 2;  // [px] smallest distance of a side from the text, in the patch
constexpr float kApart = 3;       // [px] smallest distance between two candidates of a side, in the patch
constexpr double kLeastEdge = 0.5;
constexpr int kSlopes = 17, kSamples = 40;
constexpr float kSlopeStep = 1.5f * 3.14159265f / 180;

// The surroundings of a text, upright and scaled so that the text is kHeight tall, and the text's box in them.
struct Patch {
  cv::Mat across,
      down;  // edge strength of each pixel, 0 to 1: `across` for left and right sides, `down` for upper and lower ones
  cv::Matx23f from_picture;
  float left = 0, right = 0, top = 0, bottom = 0;
};

// Strength of the edges along (dx, dy), as a share of a full edge; zero at the border of the picture.
cv::Mat edgesOf(const cv::Mat& lab, const cv::Mat& is_seen, int dx, int dy) {
  cv::Mat gradient, squares[3], sum;
  cv::Sobel(lab, gradient, CV_32F, dx, dy, 3, 1.0 / 8);
  cv::multiply(gradient, gradient, gradient);
  cv::split(gradient, squares);
  cv::sqrt(squares[0] + squares[1] + squares[2], sum);
  sum /= kFullEdge;
  cv::min(sum, 1.0, sum);
  sum.setTo(0, ~is_seen);
  cv::dilate(sum, sum, cv::Mat::ones(3, 3, CV_8U));
  return sum;
}

Patch patchAbout(const cv::Mat& picture, const Corners& text) {
  const float height = std::max(heightOf(text), 1.0f), scale = kHeight / height;
  const float width = widthOf(text) * scale;
  const Vector2f x = (text[1] - text[0] + text[2] - text[3]).normalized();
  const Vector2f y = (text[3] - text[0] + text[2] - text[1]).normalized();
  const cv::Size size(static_cast<int>(width + 2 * kReach * kHeight), static_cast<int>(kHeight + 2 * kReach * kHeight));
  const Vector2f half(0.5f * static_cast<float>(size.width), 0.5f * static_cast<float>(size.height));
  const Vector2f middle = middleOf(text);
  Patch patch;
  patch.from_picture = {scale * x.x(), scale * x.y(), half.x() - scale * x.dot(middle),
                        scale * y.x(), scale * y.y(), half.y() - scale * y.dot(middle)};
  patch.left = half.x() - 0.5f * width;
  patch.right = half.x() + 0.5f * width;
  patch.top = half.y() - 0.5f * kHeight;
  patch.bottom = half.y() + 0.5f * kHeight;
  // Before it is scaled down, the picture is smoothed, but only the part that the patch shows.
  const cv::Rect about = cv::boundingRect(std::vector<cv::Point2f>{
                             {middle.x() - (half.norm() + 4) / scale, middle.y() - (half.norm() + 4) / scale},
                             {middle.x() + (half.norm() + 4) / scale, middle.y() + (half.norm() + 4) / scale}}) &
                         cv::Rect({0, 0}, picture.size());
  if (about.empty()) return patch;
  cv::Mat part = picture(about), colours, seen;
  if (scale < 1) cv::GaussianBlur(part, part, {}, 0.4 / scale);
  cv::Matx23f from_part = patch.from_picture;
  for (int row = 0; row < 2; ++row)
    from_part(row, 2) +=
        from_part(row, 0) * static_cast<float>(about.x) + from_part(row, 1) * static_cast<float>(about.y);
  cv::warpAffine(part, colours, from_part, size, cv::INTER_LINEAR, cv::BORDER_CONSTANT);
  cv::warpAffine(cv::Mat(part.size(), CV_8U, cv::Scalar(255)), seen, from_part, size, cv::INTER_NEAREST);
  cv::erode(seen, seen, cv::Mat::ones(7, 7, CV_8U));
  cv::cvtColor(colours, colours, cv::COLOR_BGR2Lab);
  colours.convertTo(colours, CV_32F);
  cv::GaussianBlur(colours, colours, {}, 1);
  patch.across = edgesOf(colours, seen, 1, 0);
  patch.down = edgesOf(colours, seen, 0, 1);
  return patch;
}

// Whether a plate can have this shape. Of two opposite sides the nearer one looks longer, but twice as long only from
// so near that no sign is read from there.
bool isPlausible(const Corners& quad) {
  constexpr float kMost = 2;
  const auto areAlike = [](float a, float b) { return a < kMost * b && b < kMost * a; };
  return areAlike((quad[1] - quad[0]).norm(), (quad[2] - quad[3]).norm()) &&
         areAlike((quad[3] - quad[0]).norm(), (quad[2] - quad[1]).norm());
}

// A left or right side, x = at + slope (y - middle); for an upper or lower side, x and y are swapped.
struct Side {
  float at, slope, edge;
};

// Mean edge strength from y = `begin` to `end` along the line with x = `at` at y = `middle`; 0 if it leaves the patch.
float edgeAlong(const cv::Mat& edges, float at, float slope, float middle, int begin, int end) {
  float sum = 0;
  for (int y = begin; y <= end; ++y) {
    const int x = cvRound(at + slope * (static_cast<float>(y) - middle));
    if (x < 0 || x >= edges.cols) return 0;
    sum += edges.at<float>(y, x);
  }
  return sum / static_cast<float>(end - begin + 1);
}

// The strongest straight edges whose position in the middle is from `low` to `high`. They are compared by their
// strength from `begin` to `end`, and with less weight by that beyond.
std::vector<Side> sidesWithin(const cv::Mat& edges, float low, float high, float begin, float end, std::size_t most) {
  constexpr float kBeyond = 2 * kHeight, kOfBeyond = 0.3f;
  std::vector<Side> all, kept;
  const float middle = 0.5f * (begin + end);
  const auto within = [&](float y) { return std::clamp(static_cast<int>(y), 0, edges.rows - 1); };
  for (int i = 0; i < kSlopes; ++i) {
    const float slope = std::tan(static_cast<float>(i - kSlopes / 2) * kSlopeStep);
    for (float at = low; at <= high; ++at) {
      const float beside = edgeAlong(edges, at, slope, middle, within(begin), within(end));
      const float beyond = edgeAlong(edges, at, slope, middle, within(begin - kBeyond), within(end + kBeyond));
      all.push_back({at, slope, beside + kOfBeyond * beyond});
    }
  }
  std::stable_sort(all.begin(), all.end(), [](const Side& a, const Side& b) { return a.edge > b.edge; });
  for (const auto& side : all) {
    if (kept.size() == most) break;
    if (std::none_of(kept.begin(), kept.end(), [&](const Side& k) { return std::abs(k.at - side.at) <= kApart; }))
      kept.push_back(side);
  }
  return kept;
}

double edgeBetween(const cv::Mat& edges, const Vector2f& from, const Vector2f& to) {
  double sum = 0;
  for (int i = 0; i < kSamples; ++i) {
    const Vector2f at = from + (to - from) * (0.02f + 0.96f * static_cast<float>(i) / (kSamples - 1));
    const int x = cvRound(at.x()), y = cvRound(at.y());
    if (x < 0 || y < 0 || x >= edges.cols || y >= edges.rows) return 0;
    sum += edges.at<float>(y, x);
  }
  return sum / kSamples;
}

}  // namespace

std::vector<Outline> outlinesAbout(const cv::Mat& picture, const Corners& text) {
  const Patch patch = patchAbout(picture, text);
  if (patch.across.empty()) return {};
  const float columns = static_cast<float>(patch.across.cols), rows = static_cast<float>(patch.across.rows);
  const float about = 0.5f * kHeight;  // a side is longer than the text
  const auto upright = [&](float low, float high) {
    return sidesWithin(patch.across, low, high, patch.top - about, patch.bottom + about, 6);
  };
  const cv::Mat transposed = patch.down.t();
  const auto level = [&](float low, float high, std::size_t most) {
    return sidesWithin(transposed, low, high, patch.left - about, patch.right + about, most);
  };
  const auto lefts = upright(2, patch.left - kBeyondText), rights = upright(patch.right + kBeyondText, columns - 3);
  const auto tops = level(2, patch.top - kBeyondText, 8), bottoms = level(patch.bottom + kBeyondText, rows - 3, 10);
  const float middle_x = 0.5f * (patch.left + patch.right), middle_y = 0.5f * (patch.top + patch.bottom);
  const auto crossing = [&](const Side& side, const Side& lying) {
    const float y =
        (lying.at + lying.slope * (side.at - side.slope * middle_y - middle_x)) / (1 - lying.slope * side.slope);
    return Vector2f(side.at + side.slope * (y - middle_y), y);
  };
  cv::Matx23f to_picture;
  cv::invertAffineTransform(patch.from_picture, to_picture);
  std::vector<Outline> outlines;
  for (const auto& top : tops) {
    for (const auto& left : lefts) {
      for (const auto& right : rights) {
        const Vector2f upper_left = crossing(left, top), upper_right = crossing(right, top);
        const double upper = edgeBetween(patch.down, upper_left, upper_right);
        if (upper < kLeastEdge) continue;
        for (const auto& bottom : bottoms) {
          Outline outline{{upper_left, upper_right, crossing(right, bottom), crossing(left, bottom)}, 0, 0};
          const auto& q = outline.quad;
          if (!isPlausible(q)) continue;
          const double edges[] = {upper, edgeBetween(patch.across, q[1], q[2]), edgeBetween(patch.down, q[3], q[2]),
                                  edgeBetween(patch.across, q[0], q[3])};
          outline.weakest_edge = *std::min_element(std::begin(edges), std::end(edges));
          if (outline.weakest_edge < kLeastEdge) continue;
          outline.mean_edge = 0.25 * (edges[0] + edges[1] + edges[2] + edges[3]);
          for (auto& corner : outline.quad) {
            const cv::Vec2f moved = to_picture * cv::Vec3f(corner.x(), corner.y(), 1);
            corner = {moved[0], moved[1]};
          }
          outlines.push_back(outline);
        }
      }
    }
  }
  return outlines;
}

}  // namespace omnimapper::signs
