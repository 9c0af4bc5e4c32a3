// SPDX-License-Identifier: MIT
// Pushing a camera back, in a venue that is measured once.
#include <QLabel>
#include <QTemporaryDir>
#include <QtTest>

#include "relucent/image/picture_files.h"
#include "relucent/pipeline/calibrate.h"
#include "wizard/devices/nudge_dialog.h"

using namespace relucent;
using namespace relucent::gui;
using namespace relucent::image;
using namespace relucent::pipeline;
using namespace relucent::venue;

namespace {

constexpr int patience = 60000;
const StepName step{"step", "", "Step"};

/// What was seen before the view moved by `x`, `y` pixels to the right and down.
Image before(const Image& now, int x, int y) {
  Image then(now.size(), 3);
  for (int row = 0; row < now.height(); ++row)
    for (int column = 0; column < now.width(); ++column)
      for (int c = 0; c < 3; ++c)
        then.at(column, row, c) =
            now.at(std::clamp(column + x, 0, now.width() - 1), std::clamp(row + y, 0, now.height() - 1), c);
  return then;
}

}  // namespace

class TestNudge : public QObject {
  Q_OBJECT

  QTemporaryDir folder_;
  std::unique_ptr<Session> session_;
  Image flood_;

  std::filesystem::path path(const char* name) const { return folder_.filePath(name).toStdString(); }

 private slots:
  void initTestCase() {
    CalibrateSettings settings;
    VenueSettings venue;
    venue.projector = {64, 48};
    venue.camera = {80, 60};
    venue.pathsPerPixel = 16;
    settings.rig = venue;
    settings.linearization.levels = 9;
    Progress progress;
    calibrate(path("venue"), settings, path("cache"), progress);
    session_ = std::make_unique<Session>(path("cache"));
    session_->open(path("venue"));
    session_->wantAcquisition();
    QTRY_VERIFY_WITH_TIMEOUT(session_->acquisition(), patience);
    flood_ = imageFromStack(session_->acquisition()->flood, session_->acquisition()->transport.cameras(), 0);
  }

  void aCameraThatStoodStillIsAtItsPlace() {
    Nudge nudge(*session_, step);
    nudge.start();
    QVERIFY(!session_->areDevicesFree());
    QTRY_VERIFY_WITH_TIMEOUT(nudge.sight().has_value(), patience);
    QVERIFY2(nudge.sight()->isAtItsPlace(), qPrintable(QString::number(nudge.sight()->distance())));
    QSignalSpy ended(&nudge, &Nudge::ended);
    nudge.stop();
    QTRY_COMPARE_WITH_TIMEOUT(ended.size(), 1, patience);
    QVERIFY(session_->areDevicesFree() && !nudge.failure());
  }

  /// Law: the way that is told is the way that the view has moved.
  void itIsToldWhereToTurn_data() {
    QTest::addColumn<int>("x");
    QTest::addColumn<int>("y");
    QTest::addColumn<QString>("words");
    QTest::newRow("right") << 3 << 0 << NudgeDialog::tr("Turn the camera to the right.");
    QTest::newRow("up") << 0 << -3 << NudgeDialog::tr("Turn the camera up.");
    QTest::newRow("left and down") << -4 << 3 << NudgeDialog::tr("Turn the camera to the left and down.");
    QTest::newRow("nowhere") << 0 << 0 << NudgeDialog::tr("The camera looks where it looked.");
  }
  void itIsToldWhereToTurn() {
    QFETCH(int, x);
    QFETCH(int, y);
    QFETCH(QString, words);
    Nudge nudge(*session_, before(flood_, x, y));
    NudgeDialog dialog(nudge);
    dialog.show();
    nudge.start();
    QVERIFY(session_->areDevicesFree());  // whoever has them waits
    QTRY_VERIFY_WITH_TIMEOUT(nudge.sight().has_value(), patience);
    const sentinels::Movement& moved = nudge.sight()->offset.movement;
    const QString found = QString("%1, %2, %3").arg(moved.x).arg(moved.y).arg(moved.degrees);
    QVERIFY2(std::abs(moved.x - x) < 0.3 && std::abs(moved.y - y) < 0.3, qPrintable(found));
    QStringList said;
    for (const QLabel* label : dialog.findChild<QWidget*>("nudge-verdict")->findChildren<QLabel*>())
      said << label->text();
    QVERIFY2(said.contains(words), qPrintable(said.join('\n') + found));
    // What stands out is what Enter presses.
    QTRY_COMPARE(dialog.focusWidget(), dialog.findChild<QWidget*>("nudge-close"));
    QTest::keyClick(dialog.focusWidget(), Qt::Key_Return);
    QTRY_VERIFY_WITH_TIMEOUT(!dialog.isVisible(), patience);
    QVERIFY(!nudge.isLooking());
  }

  void anotherViewIsNotJudged() {
    Image other(flood_.size(), 3);
    for (std::size_t i = 0; i < other.data().size(); ++i)
      other.data()[i] = static_cast<float>((i * 7919) % 101) / 101.0f;
    Nudge nudge(*session_, other);
    nudge.start();
    QTRY_VERIFY_WITH_TIMEOUT(nudge.sight().has_value(), patience);
    QVERIFY(!nudge.sight()->isAtItsPlace() && !nudge.sight()->offset.isRecognised);
  }

  /// An arrow that no longer follows would be followed.
  void aCameraThatGoesTakesItsArrowWithIt() {
    std::filesystem::create_directories(path("desk"));
    writePng(path("desk") / "seen.png", flood_, 16);
    CalibrateSettings settings;
    CommandRigSettings commands;
    commands.projectorCommand = "true {image}";
    commands.cameraCommand = "sh -c 'cd \"$0\" && test ! -e gone && cp seen.png \"$1.png\"' " +
                             path("desk").string() + " {output} {exposure}";
    commands.projector = {64, 48};
    commands.camera = Size{80, 60};
    settings.rig = commands;
    Session session(path("cache"));
    session.begin(path("leaving"), settings);
    const DeviceLease measurement = session.leaseDevices(step);  // waits for an answer, and for its camera
    Nudge nudge(session, before(flood_, 3, 0));
    NudgeDialog dialog(nudge);
    dialog.show();
    nudge.start();
    QTRY_VERIFY_WITH_TIMEOUT(nudge.sight().has_value() || nudge.failure().has_value(), patience);
    QVERIFY2(nudge.sight(), nudge.failure() ? qPrintable(nudge.failure()->what) : "");
    const QString gone = QString::fromStdString((path("desk") / "gone").string());
    QVERIFY(QFile(gone).open(QIODevice::WriteOnly));
    QTRY_VERIFY_WITH_TIMEOUT(nudge.waiting().has_value(), patience);
    QVERIFY(!nudge.sight());
    QStringList said;
    for (const QLabel* label : dialog.findChild<QWidget*>("nudge-verdict")->findChildren<QLabel*>())
      said << label->text();
    QVERIFY2(said.contains(nudge.waiting()->sentence), qPrintable(said.join('\n')));
    QVERIFY(QFile::remove(gone));
    QTRY_VERIFY_WITH_TIMEOUT(nudge.sight() && !nudge.waiting(), patience);
    dialog.reject();
  }

  void devicesThatFailAreSaid() {
    CalibrateSettings settings;
    CommandRigSettings commands;
    commands.projectorCommand = "false {image}";
    commands.cameraCommand = "false {exposure} {output}";
    commands.projector = {64, 48};
    commands.camera = Size{80, 60};
    settings.rig = commands;
    Session session(path("cache"));
    session.begin(path("broken"), settings);
    Nudge nudge(session, flood_);
    NudgeDialog dialog(nudge);
    dialog.show();
    nudge.start();
    QTRY_VERIFY_WITH_TIMEOUT(nudge.failure().has_value(), patience);
    dialog.reject();
    QVERIFY(!dialog.isVisible());
  }
};

QTEST_MAIN(TestNudge)
#include "test_nudge.moc"
