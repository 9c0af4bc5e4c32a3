// SPDX-License-Identifier: MIT
// libgphoto2 itself, as far as it goes on a machine without a camera.
#include <QtTest>
#include <clocale>

#include "relucent/base/error.h"
#include "relucent/devices/gphoto/gphoto_driver.h"
#include "support/sentences.h"

using namespace relucent;
using namespace relucent::devices;

/// libgphoto2 2.5.30 and its part for USB keep lists of ports, and a camera that could not be connected.
extern "C" const char* __lsan_default_suppressions();  // NOLINT(bugprone-reserved-identifier)
extern "C" const char* __lsan_default_suppressions() {
  return "leak:libgphoto2\nleak:libusb\n";
}

class TestGphotoPort : public QObject {
  Q_OBJECT

 private slots:
  void aCameraThatIsNotThereIsTold() {
    const auto port = makeGphotoPort();
    try {
      port->open({"Canon EOS 80D", "usb:250,250"});
      QFAIL("no such port");
    } catch (const GphotoFailure& failure) {
      QCOMPARE(static_cast<int>(failure.fault()), static_cast<int>(GphotoFault::absent));
      QVERIFY(*failure.what() != '\0');
    }
    try {
      port->open({"A camera that was never built", "usb:"});
      QFAIL("no such model");
    } catch (const GphotoFailure& failure) {
      QCOMPARE(static_cast<int>(failure.fault()), static_cast<int>(GphotoFault::absent));
    }
    port->close();
  }

  void withoutAConnectionEveryCallFails() {
    const auto port = makeGphotoPort();
    QVERIFY_EXCEPTION_THROWN(port->get("iso"), GphotoFailure);
    QVERIFY_EXCEPTION_THROWN(port->set("iso", "100"), GphotoFailure);
    QVERIFY_EXCEPTION_THROWN(port->trigger(), GphotoFailure);
    QVERIFY_EXCEPTION_THROWN(port->waitEvent(std::chrono::milliseconds(1)), GphotoFailure);
    QVERIFY_EXCEPTION_THROWN(port->download({"/", "x"}), GphotoFailure);
    QVERIFY_EXCEPTION_THROWN(port->remove({"/", "x"}), GphotoFailure);
  }

  /// The library is asked in English; the user's language is back afterwards.
  void theLanguageIsLeftAsItWas() {
    const locale_t before = uselocale(nullptr);
    makeGphotoPort()->list();
    QCOMPARE(uselocale(nullptr), before);
  }

  void whatIsNotListedIsToldToo() {
    GphotoCameraSettings settings;
    settings.camera = "A camera that was never built";
    DrivenCameraSettings patience = gphotoPatience();
    patience.connectFor = std::chrono::milliseconds(0);
    const std::string sentence = sentenceOf(
        [&] { DrivenCamera(makeGphotoDriver(makeGphotoPort(), settings), patience); }, ErrorKind::device);
    QVERIFY(mentions(sentence, "gphoto2:A camera that was never built: "));
  }
};

QTEST_GUILESS_MAIN(TestGphotoPort)
#include "test_gphoto_port.moc"
