// SPDX-License-Identifier: MIT
// The playlist beside what plays it. On two screens, see tests/support/with-two-screens.
#include <QDoubleSpinBox>
#include <QFileDialog>
#include <QPushButton>
#include <QSettings>
#include <QStandardPaths>
#include <QTemporaryDir>
#include <QTimer>
#include <QtTest>

#include "gui/output/two_screens.h"
#include "gui/wizard/simulated_session.h"
#include "relucent/pipeline/calibrate.h"
#include "wizard/output/output_page.h"
#include "wizard/output/playlist_view.h"

using namespace relucent;
using namespace relucent::gui;

class TestPlaylistView : public QObject {
  Q_OBJECT

  SimulatedSession own_;
  QTemporaryDir folder_;
  std::unique_ptr<OutputPage> page_;
  std::unique_ptr<QWidget> part_;

  QString picture(const QString& name) const {
    QImage image(8, 8, QImage::Format_RGB32);
    image.fill(Qt::gray);
    const QString path = folder_.filePath(name);
    return image.save(path) ? path : QString();
  }
  QString ownFolder(const QString& name) const {
    return QDir(folder_.path()).mkpath(name) ? folder_.filePath(name) : QString();
  }
  void play(const QStringList& files) {
    page_->addFiles(files);
    while (page_->playlist().settings().items.size() > files.size()) page_->removeItem(0);
  }
  PlaylistView* list() const { return part_->findChild<PlaylistView*>("playlist"); }
  QDoubleSpinBox* time() const { return part_->findChild<QDoubleSpinBox*>("picture-seconds"); }
  double seconds(int row) const { return page_->playlist().settings().items[row].seconds; }

 private slots:
  void initTestCase() {
    QVERIFY(folder_.isValid());
    Progress silent;
    pipeline::calibrate(own_.path("venue"), smallVenue({48, 36}, {40, 30}, 5), own_.path("cache"), silent);
  }
  void init() {
    page_ = std::make_unique<OutputPage>(own_.session);
    own_.session.open(own_.path("venue"));
    part_.reset(playlistPart(*page_));
    part_->show();
  }
  void cleanup() {
    part_.reset();
    page_.reset();
    own_.session.close();
  }

  /// Law: the time is that of the picture that is chosen, and of no other.
  void eachPictureStandsForItsOwnTime() {
    play({picture("first.png"), picture("second.png")});
    const double usual = PlaylistItem().seconds;
    list()->setCurrentRow(1);
    QCOMPARE(time()->value(), usual);
    time()->setValue(42.5);
    QCOMPARE(seconds(0), usual);
    QCOMPARE(seconds(1), 42.5);
    list()->setCurrentRow(0);
    QCOMPARE(time()->value(), usual);
    list()->setCurrentRow(1);
    QCOMPARE(time()->value(), 42.5);
  }

  /// Half of what is typed is no time; what was typed is taken back as anything else of the page.
  void aTimeIsTyped() {
    play({picture("first.png"), picture("second.png")});
    const double usual = PlaylistItem().seconds;
    list()->setCurrentRow(0);
    time()->selectAll();
    QTest::keyClicks(time(), "25");
    QCOMPARE(seconds(0), usual);
    QTest::keyClick(time(), Qt::Key_Return);
    QCOMPARE(seconds(0), 25.0);
    page_->undoStack().undo();
    QCOMPARE(seconds(0), usual);
    QCOMPARE(time()->value(), usual);
  }

  void filmsPlayToTheirEnd_data() {
    QTest::addColumn<QString>("item");
    QTest::addColumn<bool>("stands");
    QTest::newRow("picture") << picture("second.png") << true;
    QTest::newRow("film") << folder_.filePath("film.mp4") << false;
    QTest::newRow("folder of pictures") << ownFolder("frames") << false;
    QTest::newRow("stream") << "stream:http://127.0.0.1:9/live" << true;
    QTest::newRow("screen") << "screen:DUMMY1" << true;
  }
  void filmsPlayToTheirEnd() {
    QFETCH(QString, item);
    QFETCH(bool, stands);
    play({picture("first.png"), item});
    list()->setCurrentRow(1);
    QCOMPARE(time()->isEnabled(), stands);
    if (stands) QCOMPARE(time()->value(), PlaylistItem().seconds);
    page_->setPictureSeconds(1, 5.0);
    QCOMPARE(seconds(1), stands ? 5.0 : PlaylistItem().seconds);
    list()->setCurrentRow(0);
    QVERIFY(time()->isEnabled());
  }

  /// Nobody looks for a film among the program's own files: it begins with the user's, and then where the
  /// last one was.
  void filesAreLookedForWhereTheLastOneWas() {
    const QString file = picture("third.png");
    const QStringList begins{ownFolder("pictures"), folder_.path()};
    qputenv("XDG_CONFIG_HOME", ownFolder("config").toUtf8());
    QFile places(ownFolder("config") + "/user-dirs.dirs");
    QVERIFY(places.open(QIODevice::WriteOnly));
    places.write("XDG_PICTURES_DIR=\"" + begins.first().toUtf8() + "\"\n");
    places.close();
    QSettings::setPath(QSettings::NativeFormat, QSettings::UserScope, ownFolder("config"));
    for (const QString& begin : begins) {
      bool isAsked = false;
      QTimer::singleShot(0, this, [&] {
        auto* dialog = qobject_cast<QFileDialog*>(qApp->activeModalWidget());
        isAsked = dialog != nullptr;
        if (!isAsked) return;
        QCOMPARE(dialog->directory().path(), begin);
        const QStringList kinds = dialog->nameFilters();
        QCOMPARE(kinds.size(), 2);
        for (const char* ending : {"*.png", "*.exr", "*.mp4"})
          QVERIFY2(kinds.first().contains(ending), ending);
        QVERIFY(kinds.last().endsWith("(*)"));
        dialog->setDirectory(folder_.path());
        dialog->selectFile(file);
        static_cast<QDialog*>(dialog)->accept();
      });
      part_->findChild<QPushButton*>("playlist-add")->click();
      QVERIFY(isAsked);
      QCOMPARE(page_->playlist().settings().items.last().path, file);
    }
  }

  void whatIsSkippedIsMarked() {
    QFile broken(folder_.filePath("broken.png"));
    QVERIFY(broken.open(QIODevice::WriteOnly) && broken.write("no picture") > 0);
    broken.close();
    play({picture("whole.png"), broken.fileName()});
    const auto spoken = [this](int row) {
      return list()->item(row)->data(Qt::AccessibleTextRole).toString();
    };
    std::size_t projector = 0;
    while (page_->screens().at(projector).identity.connector != "DUMMY1") ++projector;
    page_->choose(projector);
    page_->open();
    QTRY_COMPARE_WITH_TIMEOUT(spoken(1), QString("broken.png, skipped"), patience);
    QVERIFY(list()->item(1)->toolTip().contains("broken.png"));
    QTRY_COMPARE_WITH_TIMEOUT(spoken(0), QString("whole.png, playing"), patience);
    page_->close();
  }
};

QTEST_MAIN(TestPlaylistView)
#include "test_playlist_view.moc"
