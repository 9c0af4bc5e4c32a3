// SPDX-License-Identifier: MIT
// Random walks through the program itself with real devices that fail. $RELUCENT_WALK_MINUTES: seed after
// seed for so long, from $RELUCENT_WALK_SEED on; $RELUCENT_WALK_ACTIONS in each.
#include <QGuiApplication>
#include <QTemporaryDir>
#include <QtTest>

#include "gui/monkey/walk.h"
#include "relucent/devices/camera_registry.h"
#include "support/own_network.h"

using namespace relucent;
using namespace relucent::gui;
using namespace relucent::test;

namespace {

constexpr std::uint64_t diskBytes = 96 << 20;

int number(const char* name, int usual) {
  bool isGiven = false;
  const int given = qEnvironmentVariableIntValue(name, &isGiven);
  return isGiven ? given : usual;
}

}  // namespace

class TestMonkey : public QObject {
  Q_OBJECT

  SmallDisk& disk_;  // that the venues lie on
  QTemporaryDir home_;
  std::unique_ptr<FailingRoom> room_;
  std::set<QString> known_;
  WalkResult all_;

  QDir stock() const { return home_.filePath("stock"); }
  QString diskFolder() const { return QString::fromStdString(disk_.folder().string()); }

  void walk(int seed, int actions, double mostSeconds, bool findsWaits) {
    const QString own = home_.filePath(QString("seed-%1").arg(seed));
    const QString venues = diskFolder() + QString("/seed-%1").arg(seed);
    QDir().mkpath(own);
    QDir().mkpath(venues);
    WalkResult result = Walk(static_cast<unsigned>(seed), *room_, own, venues, stock())
                            .run(actions, known_, mostSeconds, findsWaits);
    // What it measured is there for those after it.
    if (!stock().exists("real") && QFile::exists(venues + "/Walk"))
      QProcess::execute("cp", {"-r", venues + "/Walk", stock().filePath("real")});
    QDir(own).removeRecursively();
    QDir(venues).removeRecursively();
    all_.actions += result.actions;
    all_.photographs += result.photographs;
    all_.restarts += result.restarts;
    all_.findings << result.findings;
    for (std::size_t i = 0; i < all_.waits.counts.size(); ++i) all_.waits.counts[i] += result.waits.counts[i];
    all_.waits.longest = std::max(all_.waits.longest, result.waits.longest);
    qInfo("seed %d: %d actions, %d photographs, started again %d times, %lld found", seed, result.actions,
          result.photographs, result.restarts, static_cast<long long>(result.findings.size()));
  }

 public:
  explicit TestMonkey(SmallDisk& disk) : disk_(disk) {}

 private slots:
  void initTestCase() {
    if (!devices::cameraRegistry().find("genicam")->isBuiltIn)
      QSKIP("this build has no Aravis, which both ends of this test need");
    QVERIFY(screenOn("DUMMY1") != nullptr);
    QVERIFY(QDir().mkpath(stock().path()));
    const QString cache = home_.filePath("cache");
    QCOMPARE(QProcess::execute(qEnvironmentVariable("RELUCENT_CLI"),
                               {"calibrate", stock().filePath("rehearsal"), "--venue", "corner",
                                "--projector", "32x24", "--camera", "28x21", "--cache", cache}),
             0);
    room_ = std::make_unique<FailingRoom>(cache.toStdString(), disk_);
    if (!room_->isRunning()) QSKIP("no GigE Vision camera can be simulated: is there a loopback network?");
  }
  void cleanupTestCase() {
    room_.reset();
    const auto& waits = all_.waits.counts;
    qInfo(
        "%d actions, %d photographs; the event loop answered within 20 ms %ld times, 100 ms %ld, 250 ms %ld, "
        "1 s %ld, "
        "later %ld; after %.0f ms at worst; started again %d times",
        all_.actions, all_.photographs, waits[0], waits[1], waits[2], waits[3], waits[4], all_.waits.longest,
        all_.restarts);
  }

  void nothingThatShouldNotBeIsFound() {
    const int first = number("RELUCENT_WALK_SEED", 1);
    const double minutes = qEnvironmentVariable("RELUCENT_WALK_MINUTES").toDouble();
    const int actions = number("RELUCENT_WALK_ACTIONS", minutes > 0.0 ? 150 : 30);
    QElapsedTimer since;
    since.start();
    const auto left = [&] { return 60.0 * minutes - 1e-3 * static_cast<double>(since.elapsed()); };
    if (minutes > 0.0)
      for (int seed = first; left() > 0.0; ++seed) walk(seed, actions, left(), true);
    else
      // Where all tests run beside each other, a second says nothing of the program.
      walk(first, actions, 120.0, false);
    QVERIFY2(all_.findings.isEmpty(), qPrintable(QString("%1 found, see above").arg(all_.findings.size())));
  }
};

int main(int argc, char** argv) {
  enterOwnNetwork();
  const QTemporaryDir folder;
  SmallDisk disk(folder.filePath("disk").toStdString(), diskBytes);
  QGuiApplication application(argc, argv);
  TestMonkey test(disk);
  return QTest::qExec(&test, argc, argv);
}
#include "test_monkey.moc"
