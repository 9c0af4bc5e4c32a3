// SPDX-License-Identifier: MIT
#include "relucent/base/message.h"
#include "relucent/devices/check/check_verdict.h"

#include <QtTest>
#include <set>

using namespace relucent;
using namespace relucent::devices;

class TestCheckVerdict : public QObject {
  Q_OBJECT

 private slots:
  /// As people read them. Programs read the ids.
  void sentences_data() {
    QTest::addColumn<CheckVerdict>("verdict");
    QTest::addColumn<QString>("text");
    auto row = [](const char* name, const CheckVerdict& verdict, const char* text) {
      QTest::newRow(name) << verdict << QString::fromUtf8(text);
    };
    row("seen", {.finding = Finding::screenSeen, .share = 0.257, .screen = "Stage (HDMI-1)"},
        "The camera sees Stage (HDMI-1): 26 % of its view follow the test pattern.");
    row("mirrored", {Finding::screenMirrored},
        "The picture appears mirrored. If it is not meant to (rear projection, a mirror), switch that off in "
        "the projector's menu.");
    row("late", {.finding = Finding::picturesLate, .count = 1},
        "Pictures arrive 1 photograph late: measure the latency, so that it is waited for.");
    row("later", {.finding = Finding::picturesLate, .count = 2},
        "Pictures arrive 2 photographs late: measure the latency, so that it is waited for.");
    row("the other", {.finding = Finding::otherScreenSeen, .screen = "HDMI-1", .instead = "HDMI-2"},
        "The camera sees HDMI-2 and not HDMI-1.");
    row("none", {.finding = Finding::screenNotSeen, .screen = "HDMI-1"}, "The camera does not see HDMI-1.");
    row("late to appear", {.finding = Finding::pictureOut, .count = 3, .seconds = 4.0 / 60.0},
        "A picture takes 67 ms to appear: each one is waited for that long.");
    row("white", {.finding = Finding::whiteChanges, .share = 0.081, .frame = 1.0 / 60.0},
        "White changes by 8.1 % from photograph to photograph: expose whole frames of the projector, "
        "multiples of 16.67 ms, and switch its dynamic brightness off.");
    row("unsteady", {.finding = Finding::lightUnsteady, .share = 0.052},
        "The light changes by 5.2 % between exposures of whole frames: let the lamp warm up, and switch "
        "off dynamic brightness and the lamps in the room.");
    row("nothing brief", {Finding::noBriefExposure},
        "The camera cannot expose for a part of a frame, or sees too little then: flicker within a frame "
        "cannot be detected.");
    row("lamp", {.finding = Finding::lampFlickers, .share = 0.4, .seconds = 0.00208, .frame = 1.0 / 60.0},
        "The lamp flickers within a frame, by 40 % in 2.1 ms: expose whole frames, multiples of 16.67 ms.");
    row("colour wheel",
        {.finding = Finding::colourWheel, .share = 1.2, .seconds = 0.00208, .frame = 1.0 / 60.0},
        "The colours come one after the other, as through a colour wheel (120 % in 2.1 ms): expose whole "
        "frames, multiples of 16.67 ms.");
    row("rolling shutter", {.finding = Finding::rollingShutter, .share = 0.07, .frame = 1.0 / 60.0},
        "The camera exposes its rows one after the other (rolling shutter): brief exposures have bands of 7 "
        "%. Expose whole frames, multiples of 16.67 ms.");
    row("dithering", {.finding = Finding::dithering, .share = 0.31},
        "The projector mixes greys in time, pixel by pixel (31 %): expose several whole frames, and switch "
        "its smoothing and 3D modes off.");
    row("even", {Finding::lightEven},
        "The light is even: no flicker, colour wheel, bands or dithering is seen.");
  }
  void sentences() {
    QFETCH(CheckVerdict, verdict);
    QFETCH(QString, text);
    QCOMPARE(QString::fromStdString(english(messageOf(verdict))), text);
  }

  void everyFindingHasASentenceOfItsOwn() {
    std::set<std::string> sentences;
    for (Finding finding : allFindings) sentences.insert(english(messageOf({finding})));
    QCOMPARE(sentences.size(), allFindings.size());
    QVERIFY(!sentences.contains(""));
  }
};

QTEST_GUILESS_MAIN(TestCheckVerdict)
#include "test_check_verdict.moc"
