// SPDX-License-Identifier: MIT
// The table of stages, and fingerprints of what their results depend on.
#include <QTemporaryDir>
#include <QTest>
#include <set>

#include "relucent/base/file.h"
#include "relucent/calibration/json.h"
#include "relucent/calibration/message_json.h"
#include "relucent/calibration/results.h"
#include "relucent/calibration/stage_fingerprint.h"
#include "relucent/calibration/stage_progress.h"

using namespace relucent;
using namespace relucent::calibration;
namespace fs = std::filesystem;

static_assert(std::is_same_v<ResultOf<Stage::threshold>, ThresholdResult>);

class TestStages : public QObject {
  Q_OBJECT

  std::unique_ptr<QTemporaryDir> temporary_;
  fs::path path() const { return temporary_->path().toStdString(); }

  /// A calibration that the last program without versions of stages made, its photographs left out: by
  /// `calibrate --venue corner --projector 16x16 --camera 16x16 --levels 5`, and decided on in the wizard.
  CalibrationFolder ofTheFirstVersion(CalibrationFolder::Access access = CalibrationFolder::Access::read) {
    writeFileAtomically(path() / "calibration.relucent",
                        readFile(RELUCENT_TEST_DATA "/first-version.relucent"));
    return CalibrationFolder::open(path(), access);
  }

 private slots:
  void init() { temporary_ = std::make_unique<QTemporaryDir>(); }

  void namesAreOfOneStageEach() {
    std::set<std::string> names;
    for (Stage stage : allValues<Stage>()) {
      names.insert(std::string(nameOf(stage)));
      QVERIFY(valueNamed<Stage>(descriptionOf(stage).name) == stage);
    }
    QCOMPARE(names.size(), stageCount);
  }

  /// As the programs before computed them: whoever changes one makes all measured venues out of date.
  void fingerprintsOfTheFirstVersionStay_data() {
    QTest::addColumn<int>("stage");
    QTest::addColumn<QByteArray>("fingerprint");
    QTest::newRow("camera") << static_cast<int>(Stage::camera)
                            << QByteArray("2029f5b20937377f7dbc8f6f0e26d7a3");
    QTest::newRow("linearization") << static_cast<int>(Stage::linearization)
                                   << QByteArray("f22a9d43872ad9a39ff15cc47c45a3e8");
    QTest::newRow("acquisition") << static_cast<int>(Stage::acquisition)
                                 << QByteArray("44aa2546ea684db35c7d669b062bdecf");
    QTest::newRow("threshold") << static_cast<int>(Stage::threshold)
                               << QByteArray("b87e6a16a751a19bfdce95b1a7cc5719");
    QTest::newRow("inverse") << static_cast<int>(Stage::inverse)
                             << QByteArray("ce7f0fb90e2fe3fca3b3ee9df73b3770");
    QTest::newRow("clustering") << static_cast<int>(Stage::clustering)
                                << QByteArray("56e2739d00b03d6a7c45961d7c16b919");
    QTest::newRow("content") << static_cast<int>(Stage::content)
                             << QByteArray("62b0f8526936c64ce612fdd2e72de648");
  }
  void fingerprintsOfTheFirstVersionStay() {
    QFETCH(int, stage);
    QFETCH(QByteArray, fingerprint);
    const CalibrationFolder folder = ofTheFirstVersion();
    QCOMPARE(fingerprintOf(folder, static_cast<Stage>(stage)), fingerprint.toStdString());
    QVERIFY(progressOf(folder, static_cast<Stage>(stage)) == StageProgress::done);
  }

  void resultsOfTheFirstVersionAreRead() {
    const StageResults results = resultsIn(ofTheFirstVersion());
    const auto& camera = std::get<std::optional<CameraCheckResult>>(results);
    QCOMPARE(camera->exposures, (std::vector<double>{0.004, 0.016, 0.064}));
    QCOMPARE(camera->latencySeconds.value(), 0.05);
    QCOMPARE(camera->verdicts, std::vector<Message>{Message::plain("The light is steady.")});
    const auto& linearization = std::get<std::optional<LinearizationResult>>(results);
    QCOMPARE(linearization->projectors, std::size_t{1});
    QCOMPARE(linearization->cameras, std::size_t{1});
    QVERIFY(linearization->cost->patterns > 0 && linearization->cost->exposures > 0);
    const auto& acquisition = std::get<std::optional<AcquisitionResult>>(results);
    QVERIFY((acquisition->projectors == std::vector<Size>{{16, 16}}));
    QVERIFY((acquisition->cameras == std::vector<Size>{{16, 16}}));
    QVERIFY(acquisition->verificationError.value() > 0.0);
    QVERIFY(acquisition->cost->seconds > 0.0 && !acquisition->cost->imported);
    const auto& threshold = std::get<std::optional<ThresholdResult>>(results);
    QCOMPARE(threshold->energyKept, 0.998);
    QCOMPARE(threshold->leaves, std::uint64_t{66567});
    const auto& inverse = std::get<std::optional<InverseResult>>(results);
    QVERIFY(inverse->ridge.value() > 0.0 && inverse->curve.size() > 1 && inverse->bytes > 0);
    const auto& clustering = std::get<std::optional<ClusteringResult>>(results);
    QCOMPARE(clustering->clusters, std::uint64_t{31});
    QCOMPARE(clustering->largest, 256U);
    QCOMPARE(clustering->errorMedian, 0.12);
    const auto& content = std::get<std::optional<ContentResult>>(results);
    QCOMPARE(content->reachable, 0.84);
    QCOMPARE(content->deltaE, 3.2);
  }

  /// Read and stored again, the manifest says the same in the same words.
  void whatIsReadIsStoredAsItWas() {
    CalibrationFolder folder = ofTheFirstVersion(CalibrationFolder::Access::write);
    const auto again = [&]<Stage stage>(auto store) {
      const StageResult before = folder.latest(stage).value();
      const StageResult after = store(folder, resultFrom<stage>(before));
      QCOMPARE(after.values->dump(), before.values->dump());
      QCOMPARE(after.inputs, before.inputs);
    };
    const auto decide = [](CalibrationFolder& to, const auto& result) { return storeDecision(to, result); };
    again.operator()<Stage::camera>(decide);
    again.operator()<Stage::threshold>(decide);
    again.operator()<Stage::clustering>(decide);
    again.operator()<Stage::content>(decide);
    again.operator()<Stage::inverse>(
        [](CalibrationFolder& to, const InverseResult& result) { return storeInverse(to, result); });
  }

  void aNewVersionOfAnAlgorithmMakesItsResultsOutOfDate() {
    const CalibrationFolder folder = ofTheFirstVersion();
    for (const StageDescription& stage : stageDescriptions) {
      StageDescription first = stage, second = stage, third = stage;
      first.version = 1;
      second.version = 2;
      third.version = 3;
      const auto fingerprint = [&](const StageDescription& of) {
        return fingerprintAfter("what came before", of, folder.settings());
      };
      QVERIFY(fingerprint(first) != fingerprint(second));
      QVERIFY(fingerprint(second) != fingerprint(third));
      // And those of whatever follows, as it is told of what came before.
      if (!stage.sections[0].empty())
        QVERIFY(fingerprintAfter(fingerprint(first), stage, folder.settings()) !=
                fingerprintAfter(fingerprint(second), stage, folder.settings()));
    }
  }

  /// Law: what follows from a measurement that was stopped early is out of date once that has gone on, and
  /// the measurement itself is not.
  void whatFollowsFromACoarseMeasurementIsOutOfDateOnceItIsFine() {
    CalibrationFolder folder = CalibrationFolder::create(path() / "coarse", Json::object(), Json::object());
    const auto measure = [&folder](const Json& values) {
      folder.store(Stage::acquisition, fingerprintOf(folder, Stage::acquisition), values);
    };
    const auto decide = [&folder] {
      storeDecision(folder, ThresholdResult());
      storeDecision(folder, ClusteringResult());
      storeDecision(folder, ContentResult());
      storeInverse(folder, {});
    };
    const auto stand = [&folder](StageProgress expected) {
      for (Stage stage : {Stage::threshold, Stage::clustering, Stage::content, Stage::inverse})
        if (progressOf(folder, stage) != expected) return false;
      return progressOf(folder, Stage::acquisition) == StageProgress::done;
    };
    const Json cost{{"seconds", 1.0}, {"patterns", 90}, {"exposures", 180}};
    measure({{"stopped_at", 8}});
    decide();
    QVERIFY(stand(StageProgress::done));
    measure({{"stopped_at", 8}, {"cost", cost}});  // further, though not to the next level
    QVERIFY(stand(StageProgress::stale));
    decide();
    const Json changed{{"what", Message::plain("it moved")}, {"moved", true}};
    measure({{"stopped_at", 0}, {"cost", cost}, {"changed", changed}});
    QVERIFY(stand(StageProgress::stale));
    decide();
    measure({{"stopped_at", 0}, {"cost", cost}});
    QVERIFY(stand(StageProgress::stale));
    decide();
    QVERIFY(stand(StageProgress::done));
  }

  /// Law: what is decided by an earlier measurement, while it is measured again, is not the new one's.
  void whatIsDecidedByAnEarlierMeasurementIsNotTheNewOnes() {
    CalibrationFolder folder = CalibrationFolder::create(path() / "earlier", Json::object(), Json::object());
    const auto measure = [&folder] {
      folder.store(Stage::acquisition, fingerprintOf(folder, Stage::acquisition), Json::object());
    };
    measure();
    storeDecision(folder, ThresholdResult());
    QVERIFY(progressOf(folder, Stage::threshold) == StageProgress::done);
    folder.setSettings({{"acquisition", {{"seed", 2}}}});
    QVERIFY(progressOf(folder, Stage::threshold) == StageProgress::stale);
    storeDecision(folder, ThresholdResult());
    QVERIFY(progressOf(folder, Stage::threshold) == StageProgress::done);
    measure();
    QVERIFY(progressOf(folder, Stage::threshold) == StageProgress::stale);
    folder.setSettings(Json::object());
    QVERIFY(progressOf(folder, Stage::threshold) == StageProgress::done);
  }

  void aStageThatWasNeverDoneHasNoResult() {
    const CalibrationFolder folder =
        CalibrationFolder::create(path() / "new", Json::object(), Json::object());
    const StageResults results = resultsIn(folder);
    QVERIFY(!std::get<std::optional<AcquisitionResult>>(results));
    for (Stage stage : allValues<Stage>()) QVERIFY(progressOf(folder, stage) == StageProgress::open);
  }

  void valuesOfAnotherKindAreAnError() {
    CalibrationFolder folder = CalibrationFolder::create(path() / "odd", Json::object(), Json::object());
    const StageResult stored = folder.store(Stage::threshold, "f", {{"kept", "most of it"}});
    try {
      (void)resultFrom<Stage::threshold>(stored);
      QFAIL("was read");
    } catch (const Error& error) {
      QVERIFY(error.kind() == ErrorKind::format);
    }
    QVERIFY_EXCEPTION_THROWN((void)resultFrom<Stage::content>(stored), std::logic_error);
  }
};

QTEST_GUILESS_MAIN(TestStages)
#include "test_stages.moc"
