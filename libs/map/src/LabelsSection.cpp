#include <omnimapper/map/Labels.h>

#include <cmath>

#include "SectionBytes.h"

namespace omnimapper::map {

namespace {

void writePoint(ByteWriter& out, const Eigen::Vector3d& point) {
  for (int i = 0; i < 3; ++i) out.real(point[i]);
}

Eigen::Vector3d readPoint(ByteReader& in) {
  Eigen::Vector3d point;
  for (int i = 0; i < 3; ++i) point[i] = in.real();
  if (!point.allFinite()) refuse(Labels::kLayer, "has a point that is not finite: the file is damaged");
  return point;
}

double readProbability(ByteReader& in) {
  const double probability = in.real();
  if (!(probability >= 0 && probability <= 1))
    refuse(Labels::kLayer, "has a probability that is none: the file is damaged");
  return probability;
}

std::string readText(ByteReader& in) {
  std::string text(in.block());
  if (text.empty()) refuse(Labels::kLayer, "has a label without text: the file is damaged");
  return text;
}

void writeLabel(ByteWriter& out, const Label& label) {
  out.block(label.text);
  out.uint(label.landmark ? 1 : 0, 1);
  writeId(out, label.landmark.value_or(base::LandmarkId{}));
  writeId(out, label.frame);
  writePoint(out, label.in_frame);
  out.block(label.who);
  writeStamp(out, label.when);
  out.real(label.probability);
}

Label readLabel(ByteReader& in) {
  Label label;
  label.text = readText(in);
  const bool has_landmark = in.uint(1) != 0;
  const auto landmark = readId<base::LandmarkTag>(in);
  if (has_landmark) label.landmark = landmark;
  label.frame = readId<base::KeyFrameTag>(in);
  label.in_frame = readPoint(in);
  label.who = std::string(in.block());
  label.when = readStamp(in);
  label.probability = readProbability(in);
  return label;
}

void writeQuestion(ByteWriter& out, const LabelQuestion& question) {
  out.block(question.text);
  out.block(question.who);
  writeStamp(out, question.when);
  writeId(out, question.frame);
  out.uint(question.choices.size(), 4);
  for (const auto& choice : question.choices) {
    writeId(out, choice.landmark);
    writePoint(out, choice.in_frame);
    out.real(choice.probability);
  }
}

LabelQuestion readQuestion(ByteReader& in) {
  LabelQuestion question;
  question.text = readText(in);
  question.who = std::string(in.block());
  question.when = readStamp(in);
  question.frame = readId<base::KeyFrameTag>(in);
  for (auto left = in.uint(4); left > 0; --left) {
    const auto landmark = readId<base::LandmarkTag>(in);
    const Eigen::Vector3d point = readPoint(in);
    question.choices.push_back({landmark, point, readProbability(in)});
  }
  if (question.choices.empty()) refuse(Labels::kLayer, "has a question without choices: the file is damaged");
  return question;
}

}  // namespace

std::string Labels::toBytes() const {
  ByteWriter out;
  out.uint(labels.size(), 4);
  for (const Label& label : labels) writeLabel(out, label);
  out.uint(question ? 1 : 0, 1);
  if (question) writeQuestion(out, *question);
  return out.take();
}

Labels Labels::fromSection(const MapSection& section) {
  expectSection(section, kLayer, kLayerVersion);
  ByteReader in(section.bytes, placeOf(kLayer));
  Labels read;
  for (auto left = in.uint(4); left > 0; --left) read.labels.push_back(readLabel(in));
  if (in.uint(1) != 0) read.question = readQuestion(in);
  expectEnd(in, kLayer);
  return read;
}

LayerReferences Labels::references() const {
  LayerReferences references;
  for (const Label& label : labels) {
    references.key_frames.push_back(label.frame);
    if (label.landmark) references.landmarks.push_back(*label.landmark);
  }
  if (question) {
    references.key_frames.push_back(question->frame);
    for (const auto& choice : question->choices) references.landmarks.push_back(choice.landmark);
  }
  return references;
}

}  // namespace omnimapper::map
