// SPDX-License-Identifier: MIT
// How streams get into Output's playlist. On two screens, see tests/support/with-two-screens.
#include <QMenu>
#include <QTemporaryDir>
#include <QtTest>
#include <algorithm>

#include "gui/app/layout_faults.h"
#include "gui/app/naming_faults.h"
#include "gui/wizard/simulated_session.h"
#include "relucent/base/file.h"
#include "wizard/output/output_page.h"
#include "wizard/output/playlist_view.h"
#include "wizard/output/screen_menu.h"
#include "wizard/output/stream_dialog.h"

using namespace relucent;
using namespace relucent::gui;

class TestStreamDialog : public QObject {
  Q_OBJECT

  static QLineEdit& addressOf(const StreamDialog& dialog) {
    return *dialog.findChild<QLineEdit*>("stream-address");
  }

 private slots:
  void asksForAddressAndHold_data() {
    QTest::addColumn<QString>("typed");
    QTest::addColumn<int>("hold");
    QTest::addColumn<QString>("path");
    QTest::newRow("last picture") << " rtsp://camera/live " << 0 << "stream:rtsp://camera/live";
    QTest::newRow("black") << "rtsp://camera/live" << 1 << "stream:rtsp://camera/live#hold=black";
    QTest::newRow("as in a list") << "stream:udp://:5004" << 0 << "stream:udp://:5004";
    QTest::newRow("already said") << "http://a/b#hold=last" << 1 << "stream:http://a/b#hold=last";
  }
  void asksForAddressAndHold() {
    QFETCH(QString, typed);
    QFETCH(int, hold);
    StreamDialog dialog;
    dialog.show();
    QSignalSpy chosen(&dialog, &StreamDialog::chosen);
    QVERIFY(addressOf(dialog).hasFocus() || dialog.focusWidget() == &addressOf(dialog));
    QTest::keyClicks(&addressOf(dialog), typed);
    auto* choice = dialog.findChild<Segmented*>("stream-hold");
    choice->findChildren<QAbstractButton*>().at(hold)->click();
    QCOMPARE(choice->current(), hold);
    QTest::keyClick(&dialog, Qt::Key_Return);
    QCOMPARE(chosen.size(), 1);
    QTEST(chosen[0][0].toString(), "path");
    QVERIFY(!dialog.isVisible());
  }

  void whatIsNoAddressIsSaidAtOnce() {
    StreamDialog dialog;
    dialog.show();
    QSignalSpy chosen(&dialog, &StreamDialog::chosen);
    auto* wrong = dialog.findChild<Note*>("stream-wrong");
    QVERIFY(!wrong->isVisible());
    QTest::keyClicks(&addressOf(dialog), "file:///etc/passwd");
    dialog.findChild<QPushButton*>("stream-add")->click();
    QVERIFY(wrong->isVisible() && dialog.isVisible() && chosen.isEmpty());
    for (int i = 0; i < 3; ++i) QCoreApplication::processEvents();
    const QStringList faults = LayoutFaults::of(dialog) + NamingFaults::of(dialog);
    QVERIFY2(faults.isEmpty(), qPrintable(faults.join('\n')));
    QTest::keyClicks(&addressOf(dialog), "x");
    QVERIFY(!wrong->isVisible());
    QTest::keyClick(&dialog, Qt::Key_Escape);
    QVERIFY(!dialog.isVisible() && chosen.isEmpty());
  }

  /// What is typed is kept, and what is secret of it seen nowhere.
  void getsIntoThePlaylist() {
    SimulatedSession own;
    OutputPage page(own.session);
    own.begin();
    const std::unique_ptr<QWidget> part(playlistPart(page));
    part->show();
    part->findChild<QPushButton*>("playlist-stream")->click();
    auto* dialog = part->findChild<StreamDialog*>("stream-dialog");
    QVERIFY(dialog != nullptr && dialog->isModal());
    QTest::keyClicks(&addressOf(*dialog), "rtsp://user:secret@camera/live");
    dialog->findChild<QPushButton*>("stream-add")->click();
    const QString path = "stream:rtsp://user:secret@camera/live";
    QCOMPARE(page.playlist().settings().items.last().path, path);
    QVERIFY(readFile(page.playlist().file().toStdString()).find(path.toStdString()) != std::string::npos);
    const auto* list = part->findChild<PlaylistView*>("playlist");
    const QListWidgetItem* item = list->item(list->count() - 1);
    QCOMPARE(item->text(), QString("rtsp://camera/live"));
    for (int role : {int(Qt::DisplayRole), int(Qt::ToolTipRole), int(Qt::AccessibleTextRole)})
      QVERIFY2(!item->data(role).toString().contains("secret"), qPrintable(item->data(role).toString()));
  }

  void screensAndWindowsGetIntoThePlaylist_data() {
    QTest::addColumn<QByteArray>("wayland");
    QTest::addColumn<QString>("path");
    QTest::newRow("X") << QByteArray() << "screen:DUMMY1";
    QTest::newRow("Wayland") << QByteArray("wayland-0") << "screen:1";
  }
  void screensAndWindowsGetIntoThePlaylist() {
    QFETCH(QByteArray, wayland);
    QFETCH(QString, path);
    qputenv("WAYLAND_DISPLAY", wayland);
    SimulatedSession own;
    OutputPage page(own.session);
    own.begin();
    const std::unique_ptr<QWidget> part(playlistPart(page));
    QMenu* menu = part->findChild<QPushButton*>("playlist-screen")->menu();
    Q_EMIT menu->aboutToShow();
    const QList<ScreenOffer> offers = screenOffers({});
    const auto offer = std::ranges::find(offers, path, &ScreenOffer::path);
    QVERIFY(offer != offers.end());
    QCOMPARE(menu->actions().size(), offers.size());
    menu->actions().at(offer - offers.begin())->trigger();
    QCOMPARE(page.playlist().settings().items.last().path, path);
    // Another one is chosen anew.
    if (!wayland.isEmpty()) QCOMPARE(screenOffers({path}).first().path, QString("screen:2"));
    qunsetenv("WAYLAND_DISPLAY");
  }
};

QTEST_MAIN(TestStreamDialog)
#include "test_stream_dialog.moc"
