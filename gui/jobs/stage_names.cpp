// SPDX-License-Identifier: MIT
#include "jobs/stage_names.h"

#include <QCoreApplication>
#include <QStringList>
#include <array>

#include "jobs/sentence_table.h"

namespace relucent {
namespace {

constexpr std::array stages{
    QT_TRANSLATE_NOOP("Stage", "Algorithm 1"),
    QT_TRANSLATE_NOOP("Stage", "Assembling the light transport"),
    QT_TRANSLATE_NOOP("Stage", "Calibrating"),
    QT_TRANSLATE_NOOP("Stage", "Checking that the colours of {} add up"),
    QT_TRANSLATE_NOOP("Stage", "Clustering the light transport"),
    QT_TRANSLATE_NOOP("Stage", "Clusters held to a size"),
    QT_TRANSLATE_NOOP("Stage", "Comparing the inverses of clusters in {}"),
    QT_TRANSLATE_NOOP("Stage", "Comparing the methods"),
    QT_TRANSLATE_NOOP("Stage", "Comparing the methods in {}"),
    QT_TRANSLATE_NOOP("Stage", "Compensating"),
    QT_TRANSLATE_NOOP("Stage", "Decoding"),
    QT_TRANSLATE_NOOP("Stage", "Estimating response and colours"),
    QT_TRANSLATE_NOOP("Stage", "Estimating the light transport"),
    QT_TRANSLATE_NOOP("Stage", "Evaluating"),
    QT_TRANSLATE_NOOP("Stage", "Finding the defocus"),
    QT_TRANSLATE_NOOP("Stage", "Finding the exposure"),
    QT_TRANSLATE_NOOP("Stage", "Fitting the spread of light"),
    QT_TRANSLATE_NOOP("Stage", "Forming patches"),
    QT_TRANSLATE_NOOP("Stage", "Holding clusters to a size"),
    QT_TRANSLATE_NOOP("Stage", "Inverting the clusters"),
    QT_TRANSLATE_NOOP("Stage", "Inverting the light transport"),
    QT_TRANSLATE_NOOP("Stage", "Inverting {}"),
    QT_TRANSLATE_NOOP("Stage", "Joining clusters"),
    QT_TRANSLATE_NOOP("Stage", "Linearizing"),
    QT_TRANSLATE_NOOP("Stage", "Looking for shadows"),
    QT_TRANSLATE_NOOP("Stage", "Looking for what cannot be corrected"),
    QT_TRANSLATE_NOOP("Stage", "Measuring the brightness curves of {}"),
    QT_TRANSLATE_NOOP("Stage", "Measuring the camera"),
    QT_TRANSLATE_NOOP("Stage", "Judging the light"),
    QT_TRANSLATE_NOOP("Stage", "Looking for the projector's picture"),
    QT_TRANSLATE_NOOP("Stage", "Measuring the latency"),
    QT_TRANSLATE_NOOP("Stage", "Measuring the light transport"),
    QT_TRANSLATE_NOOP("Stage", "Measuring {}"),
    QT_TRANSLATE_NOOP("Stage", "Photographing test patterns"),
    QT_TRANSLATE_NOOP("Stage", "Photographing the projections"),
    QT_TRANSLATE_NOOP("Stage", "Predicting held-out patterns"),
    QT_TRANSLATE_NOOP("Stage", "Preparing the benchmarks"),
    QT_TRANSLATE_NOOP("Stage", "Preparing the devices"),
    QT_TRANSLATE_NOOP("Stage", "Preparing the engine"),
    QT_TRANSLATE_NOOP("Stage", "Preparing the venue"),
    QT_TRANSLATE_NOOP("Stage", "Reading the calibration"),
    QT_TRANSLATE_NOOP("Stage", "Reading the patterns"),
    QT_TRANSLATE_NOOP("Stage", "Reading the photographs"),
    QT_TRANSLATE_NOOP("Stage", "Reading the pictures"),
    QT_TRANSLATE_NOOP("Stage", "Reading {}"),
    QT_TRANSLATE_NOOP("Stage", "Scaling to the flood image"),
    QT_TRANSLATE_NOOP("Stage", "Separating direct and indirect light"),
    QT_TRANSLATE_NOOP("Stage", "Sharpening"),
    QT_TRANSLATE_NOOP("Stage", "Solving"),
    QT_TRANSLATE_NOOP("Stage", "Timing the engine"),
    QT_TRANSLATE_NOOP("Stage", "Windows"),
    QT_TRANSLATE_NOOP("Stage", "Writing"),
    QT_TRANSLATE_NOOP("Stage", "Writing out the light transport"),
    QT_TRANSLATE_NOOP("Stage", "Writing the results"),
    QT_TRANSLATE_NOOP("Stage", "black and full light"),
    "level {} of {}: {} patterns",
    QT_TRANSLATE_NOOP("Stage", "light transport"),
    "measuring {} flagged pixels again",
    QT_TRANSLATE_NOOP("Stage", "projector {}"),
    QT_TRANSLATE_NOOP("Stage", "test patterns"),
    QT_TRANSLATE_NOOP("Stage", "the projector"),
    QT_TRANSLATE_NOOP("Stage", "tracing the simulated venue"),
};

/// Those that count: the sentence has another form for another number.
struct Counting {
  std::string_view stage;
  const char* sentence;
  qsizetype count;  // which of the stage's names
};
constexpr std::array counting{
    Counting{"level {} of {}: {} patterns", QT_TRANSLATE_N_NOOP("Stage", "level {} of {}: %n pattern(s)"), 2},
    Counting{"measuring {} flagged pixels again",
             QT_TRANSLATE_N_NOOP("Stage", "measuring %n flagged pixel(s) again"), 0}};

QString filled(const char* stage, QStringList names) {
  QString text = QCoreApplication::translate("Stage", stage);
  for (const Counting& counted : counting)
    if (counted.stage == stage)
      text = QCoreApplication::translate("Stage", counted.sentence, nullptr,
                                         names.takeAt(counted.count).toInt());
  for (QString& name : names) name = stageText(name.toStdString());
  return filledIn(text, names);
}

}  // namespace

std::span<const char* const> knownStages() {
  return stages;
}

QString stageText(std::string_view stage) {
  QString text = QString::fromUtf8(stage.data(), static_cast<qsizetype>(stage.size()));
  static const SentenceTable table(stages);
  if (auto known = table.find(text)) return filled(known->sentence, known->parts);
  return text;
}

}  // namespace relucent
