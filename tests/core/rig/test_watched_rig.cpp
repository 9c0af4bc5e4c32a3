// SPDX-License-Identifier: MIT
#include "relucent/rig/watched_rig.h"

#include <QtTest>
#include <stdexcept>

using namespace relucent;
using namespace relucent::image;
using namespace relucent::rig;

namespace {

class LoggedProjector : public Projector {
 public:
  explicit LoggedProjector(QStringList& log) : log_(log) {}
  std::string name() const override { return "logged"; }
  Size size() const override { return {2, 1}; }
  int bits() const override { return 10; }
  void show(const Image& drive) override {
    log_ << QString("show %1").arg(static_cast<double>(drive.at(0, 0, 0)));
  }

 private:
  QStringList& log_;
};

class LoggedCamera : public Camera {
 public:
  explicit LoggedCamera(QStringList& log) : log_(log) {}
  std::string name() const override { return "eye"; }
  Size size() const override { return {1, 1}; }
  ExposureRange exposures() const override { return {0.25, 2.0}; }
  RawFrame capture(const CaptureRequest& request) override {
    log_ << QString("capture %1").arg(request.shot.number);
    if (request.shot.number < 0) throw std::runtime_error("no answer");
    return {Image({1, 1}, 3, 0.5f), 12, request.seconds};
  }

 private:
  QStringList& log_;
};

class Notes : public RigWatcher {
 public:
  explicit Notes(QStringList& log) : log_(log) {}
  void beforeShowing(std::size_t index, RigLight& light) override {
    log_ << QString("before %1").arg(index);
    if (paused) {
      light.darken();
      log_ << "resumed";
      light.restore();
    }
    if (fails) throw std::runtime_error("no more");
  }
  void shown(std::size_t index, const Image& drive) override {
    log_ << QString("shown %1 %2").arg(index).arg(static_cast<double>(drive.at(1, 0, 2)));
  }
  void photographed(std::size_t index, const CaptureRequest& request, const RawFrame& frame) override {
    log_ << QString("photographed %1 %2 %3").arg(index).arg(request.shot.number).arg(frame.seconds);
  }
  void beforePhotographing(std::size_t index, const CaptureRequest& request) override {
    log_ << QString("asked %1 %2").arg(index).arg(request.seconds);
  }
  void afterPhotographing(std::size_t index) noexcept override { log_ << QString("over %1").arg(index); }
  bool paused = false, fails = false;

 private:
  QStringList& log_;
};

}  // namespace

class TestWatchedRig : public QObject {
  Q_OBJECT

  QStringList log_;
  std::shared_ptr<Notes> notes_;
  Rig rig_;

 private slots:
  void init() {
    log_.clear();
    notes_ = std::make_shared<Notes>(log_);
    Rig rig;
    rig.projectors.push_back(std::make_unique<LoggedProjector>(log_));
    rig.projectors.push_back(std::make_unique<LoggedProjector>(log_));
    rig.cameras.push_back(std::make_unique<LoggedCamera>(log_));
    rig_ = watched(std::move(rig), notes_);
  }

  void devicesAreWhatTheyWere() {
    QCOMPARE(rig_.projectorRasters(), Rasters({{2, 1}, {2, 1}}));
    QCOMPARE(rig_.projectors[1]->bits(), 10);
    QCOMPARE(rig_.cameras[0]->exposures().longest, 2.0);
    QCOMPARE(QString::fromStdString(rig_.cameras[0]->name()), QString("eye"));
  }

  void everyPatternAndFrameIsSeenInOrder() {
    rig_.projectors[1]->show(Image({2, 1}, 3, 0.25f));
    RawFrame frame = rig_.cameras[0]->capture({{"stage", 7}, 0, 0.5});
    QCOMPARE(frame.signal, Image({1, 1}, 3, 0.5f));
    QCOMPARE(log_, QStringList({"before 1", "show 0.25", "shown 1 0.25", "asked 0 0.5", "capture 7", "over 0",
                                "photographed 0 7 0.5"}));
  }

  /// Whoever waits for a photograph learns that it will not come.
  void aPhotographThatFailsIsOverAsWell() {
    QVERIFY_EXCEPTION_THROWN(rig_.cameras[0]->capture({{"stage", -1}, 0, 2.0}), std::runtime_error);
    QCOMPARE(log_, QStringList({"asked 0 2", "capture -1", "over 0"}));
  }

  /// Of the first shot each projector is dark; later, the one that has its pattern already has it again.
  void aPauseDarkensAllProjectorsAndGivesTheirPatternsBack() {
    notes_->paused = true;
    rig_.projectors[0]->show(Image({2, 1}, 3, 1.0f));
    QCOMPARE(log_, QStringList({"before 0", "show 0", "show 0", "resumed", "show 1", "shown 0 1"}));
    log_.clear();
    rig_.projectors[1]->show(Image({2, 1}, 3, 0.5f));
    QCOMPARE(log_,
             QStringList({"before 1", "show 0", "show 0", "resumed", "show 1", "show 0.5", "shown 1 0.5"}));
  }

  void whatTheWatcherThrowsEndsTheCall() {
    notes_->fails = true;
    QVERIFY_EXCEPTION_THROWN(rig_.projectors[0]->show(Image({2, 1}, 3, 1.0f)), std::runtime_error);
    QCOMPARE(log_, QStringList({"before 0"}));
  }
};

QTEST_GUILESS_MAIN(TestWatchedRig)
#include "test_watched_rig.moc"
