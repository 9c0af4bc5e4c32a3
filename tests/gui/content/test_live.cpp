// SPDX-License-Identifier: MIT
// Runs on two screens that can be unplugged, see tests/support/with-two-screens.
#include <QCameraDevice>
#include <QMediaDevices>
#include <QPainter>
#include <QRasterWindow>
#include <QtTest>

#include "content/live_camera.h"
#include "content/live_screen.h"
#include "content/media_thread.h"
#include "content/playlist.h"
#include "gui/output/two_screens.h"
#include "support/sentences.h"

using namespace relucent;
using namespace relucent::compensation;
using namespace relucent::gui;

namespace {

/// A window that shows a picture.
class Shown : public QRasterWindow {
 public:
  explicit Shown(const QImage& picture) : picture_(picture) {
    setFlags(Qt::FramelessWindowHint);
    setTitle("Slides of the evening");
    resize(picture.size());
  }
  void show(const QImage& picture) {
    picture_ = picture;
    update();
  }

 protected:
  void paintEvent(QPaintEvent*) override { QPainter(this).drawImage(0, 0, picture_); }

 private:
  QImage picture_;
};

QImage rgb(const ContentPicture& picture) {
  return picture.image.convertToFormat(QImage::Format_RGB32);
}

}  // namespace

class TestLive : public QObject {
  Q_OBJECT

  const QSize size_{301, 203};
  Canvas canvas() const { return {size_, Fit::fill}; }
  ContentTime time_{0};
  /// A show whose time goes on.
  ContentTime next() { return time_ += std::chrono::milliseconds(1); }

 private slots:
  void cleanup() {
    if (screenOn("DUMMY1") == nullptr) plug();
  }

  void aScreenIsSeenAsItStands() {
    QImage picture = noise(screenOn("DUMMY1")->size(), 1);
    Shown window(picture);
    window.setGeometry(screenOn("DUMMY1")->geometry());
    window.QWindow::show();
    LiveScreen live(LiveScreen::What::screen, "DUMMY1", {picture.size(), Fit::fill});
    QTRY_VERIFY(rgb(live.at(next())) == picture);
    std::uint64_t number = live.at(next()).number;
    QCOMPARE(live.at(next()).number, number);  // nothing has changed
    picture = noise(picture.size(), 2);
    window.show(picture);
    QTRY_VERIFY(rgb(live.at(next())) == picture);
    QVERIFY(live.at(next()).number != number);
  }

  void standsWhileTimeStands() {
    const QImage before = noise(screenOn("DUMMY1")->size(), 1), after = noise(before.size(), 2);
    Shown window(before);
    window.setGeometry(screenOn("DUMMY1")->geometry());
    window.QWindow::show();
    LiveScreen live(LiveScreen::What::screen, "DUMMY1", {before.size(), Fit::fill});
    QTRY_VERIFY(rgb(live.at(next())) == before);
    window.show(after);
    QTRY_VERIFY(seenOn("DUMMY1") == after);
    QVERIFY(rgb(live.at(time_)) == before);
    QVERIFY(rgb(live.at(next())) == after);
  }

  void anUnpluggedScreenLeavesItsLastPicture() {
    LiveScreen live(LiveScreen::What::screen, "DUMMY1", canvas());
    QImage before = live.at(next()).image;
    unplug();
    QVERIFY(live.at(next()).image == before);
    plug();
    QCOMPARE(live.at(next()).image.size(), size_);
  }

  void aWindowIsFoundByItsTitleOrNumber_data() {
    QTest::addColumn<bool>("byNumber");
    QTest::newRow("title") << false;
    QTest::newRow("number") << true;
  }
  void aWindowIsFoundByItsTitleOrNumber() {
    QFETCH(bool, byNumber);
    QImage picture = noise(size_, 3);
    auto window = std::make_unique<Shown>(picture);
    window->setPosition(50, 60);
    window->QWindow::show();
    QVERIFY(QTest::qWaitForWindowExposed(window.get()));
    QString which = byNumber ? QString("0x%1").arg(window->winId(), 0, 16) : "slides OF";
    LiveScreen live(LiveScreen::What::window, which, canvas());
    QTRY_VERIFY(rgb(live.at(next())) == picture);
    window.reset();
    QVERIFY(rgb(live.at(next())) == picture);  // its last one
  }

  void whatIsNotThereIsNamed() {
    QVERIFY(mentions(
        sentenceOf([&] { LiveScreen(LiveScreen::What::screen, "HDMI-7", canvas()); }, ErrorKind::input),
        "DUMMY0"));
    QVERIFY(mentions(
        sentenceOf([&] { LiveScreen(LiveScreen::What::window, "no such", canvas()); }, ErrorKind::input),
        "no such"));
    QVERIFY(mentions(sentenceOf([&] { LiveCamera("no such camera", canvas()); }, ErrorKind::device),
                     "capture device"));
    QByteArray display = qgetenv("DISPLAY");
    qputenv("DISPLAY", ":nowhere");
    QVERIFY(mentions(
        sentenceOf([&] { LiveScreen(LiveScreen::What::screen, "DUMMY0", canvas()); }, ErrorKind::device),
        "X server"));
    qputenv("DISPLAY", display);
  }

  void playlistsNameThem() {
    QCOMPARE(openContent({"screen:DUMMY0"}, canvas())->at({}).image.size(), size_);
    QVERIFY(mentions(sentenceOf([&] { openContent({"window:no such"}, canvas()); }, ErrorKind::input),
                     "no such"));
    QVERIFY(mentions(sentenceOf([&] { openContent({"camera:no such"}, canvas()); }, ErrorKind::device),
                     "device"));
  }

  void aCaptureDeviceGivesPictures() {
    chooseMediaBackend();
    if (QMediaDevices::videoInputs().isEmpty()) QSKIP("this machine has no capture device");
    LiveCamera live("", canvas());
    QCOMPARE(live.at(next()).image.size(), size_);
    std::uint64_t first = live.at(next()).number;
    QTRY_VERIFY(live.at(next()).number != first);
  }
};

QTEST_MAIN(TestLive)
#include "test_live.moc"
