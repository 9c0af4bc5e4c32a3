// SPDX-License-Identifier: MIT
#include "output/output_playlist.h"

#include <QFile>
#include <QSignalSpy>
#include <QTemporaryDir>
#include <QtTest>

#include "output/default_picture.h"
#include "relucent/base/error.h"

using namespace relucent;
using namespace relucent::gui;

class TestOutputPlaylist : public QObject {
  Q_OBJECT

  static QStringList names(const OutputPlaylist& list) {
    QStringList paths;
    for (const PlaylistItem& item : list.settings().items) paths << item.path;
    return paths;
  }

 private slots:
  void untilItIsEditedItIsTheContentOfPreview() {
    QTemporaryDir folder;
    OutputPlaylist list;
    list.open(folder.path(), {});
    QCOMPARE(names(list), QStringList{defaultPicture()});
    list.prefer("/a.png");
    QCOMPARE(names(list), QStringList{"/a.png"});
    QVERIFY(!QFile::exists(list.file()));

    list.set(list.withAdded({"/b.mp4", "", "/c.png"}));
    QCOMPARE(names(list), (QStringList{"/a.png", "/b.mp4", "/c.png"}));
    list.prefer("/b.mp4");
    QCOMPARE(list.settings().items.size(), 3);
    list.prefer("/d.png");
    QCOMPARE(names(list), (QStringList{"/d.png", "/a.png", "/b.mp4", "/c.png"}));
  }

  void itIsThereAgain() {
    QTemporaryDir folder;
    OutputPlaylist list, again;
    list.open(folder.path(), "/a.png");
    PlaylistSettings settings = list.withAdded({"/b.mp4"});
    settings.fadeSeconds = 2.5;
    settings.loop = false;
    list.set(settings);
    again.open(folder.path(), "/else.png");
    QCOMPARE(again.settings(), settings);
  }

  void theProgramsOwnPictureIsKeptBesideIt() {
    QTemporaryDir folder;
    OutputPlaylist list, again;
    list.open(folder.path(), {});
    list.save();
    again.open(folder.path(), {});
    QCOMPARE(names(again), QStringList{folder.filePath("demonstration.png")});
    QVERIFY(QFile::exists(folder.filePath("demonstration.png")));
    QCOMPARE(OutputPlaylist::nameOf(again.settings().items.front().path),
             OutputPlaylist::nameOf({defaultPicture()}));
  }

  void moving_data() {
    QTest::addColumn<int>("index");
    QTest::addColumn<int>("by");
    QTest::addColumn<QString>("order");
    QTest::newRow("up") << 1 << -1 << "bac";
    QTest::newRow("down") << 1 << 1 << "acb";
    QTest::newRow("far") << 0 << 2 << "bca";
    QTest::newRow("above the first") << 0 << -1 << "abc";
    QTest::newRow("below the last") << 2 << 1 << "abc";
    QTest::newRow("none") << -1 << 1 << "abc";
    QTest::newRow("no such one") << 7 << -1 << "abc";
  }
  void moving() {
    QFETCH(int, index);
    QFETCH(int, by);
    QFETCH(QString, order);
    QTemporaryDir folder;
    OutputPlaylist list;
    list.open(folder.path(), "a");
    list.set(list.withAdded({"b", "c"}));
    PlaylistSettings moved = list.withMoved(index, by);
    QString now;
    for (const PlaylistItem& item : moved.items) now += item.path;
    QCOMPARE(now, order);
  }

  void removingTheLastLeavesNothingToPlay() {
    QTemporaryDir folder;
    OutputPlaylist list;
    list.open(folder.path(), "a");
    QCOMPARE(list.without(5).items.size(), 1);
    QCOMPARE(list.without(-1).items.size(), 1);
    list.set(list.without(0));
    QVERIFY(list.isEmpty());
    QVERIFY(!list.problems().empty());
  }

  void aDamagedListIsToldAndBegunAnew() {
    QTemporaryDir folder;
    QFile file(folder.filePath("show.playlist"));
    QVERIFY(file.open(QIODevice::WriteOnly));
    file.write("no playlist");
    file.close();
    OutputPlaylist list;
    QSignalSpy told(&list, &OutputPlaylist::unreadable);
    list.open(folder.path(), "/a.png");
    QCOMPARE(told.size(), 1);
    QCOMPARE(names(list), QStringList{"/a.png"});
  }

  void whereItCannotBeWrittenItPlaysAllTheSame() {
    OutputPlaylist list;
    list.open("/proc/nowhere", "/a.png");
    QVERIFY_EXCEPTION_THROWN(list.set(list.withAdded({"/b.png"})), Error);
    QCOMPARE(list.settings().items.size(), 2);
  }

  void stillsAreTold_data() {
    QTest::addColumn<QString>("path");
    QTest::addColumn<bool>("still");
    QTest::newRow("picture") << "/a/b.png" << true;
    QTest::newRow("own") << defaultPicture() << true;
    QTest::newRow("film") << "/a/b.mp4" << false;
    QTest::newRow("folder of pictures") << QDir::tempPath() << false;
    QTest::newRow("camera") << "camera:USB" << false;
    QTest::newRow("stream") << "stream:http://user:secret@camera/picture.jpg" << false;
  }
  void stillsAreTold() {
    QFETCH(QString, path);
    QFETCH(bool, still);
    QCOMPARE(OutputPlaylist::isStill({path}), still);
    QVERIFY(!OutputPlaylist::nameOf({path}).isEmpty());
    QVERIFY(!OutputPlaylist::nameOf({path}).contains("secret"));
  }
};

QTEST_GUILESS_MAIN(TestOutputPlaylist)
#include "test_output_playlist.moc"
