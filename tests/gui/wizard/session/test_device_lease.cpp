// SPDX-License-Identifier: MIT
// Devices are used by one step at a time.
#include "wizard/session/device_lease.h"

#include <QSignalSpy>
#include <QTranslator>
#include <QtTest>
#include <memory>
#include <stdexcept>

#include "wizard/session/session.h"

using namespace relucent;
using namespace relucent::gui;

namespace {

constexpr StepName camera{"camera", "relucent::gui::CameraPage", "Camera"};
constexpr StepName acquire{"acquire", "relucent::gui::AcquirePage", "Acquire"};

/// Every text in capitals.
class Loud : public QTranslator {
 public:
  bool isEmpty() const override { return false; }
  QString translate(const char*, const char* text, const char*, int) const override {
    return QString(text).toUpper();
  }
};

}  // namespace

class TestDeviceLease : public QObject {
  Q_OBJECT

  std::unique_ptr<Session> session_;

 private slots:
  void init() { session_ = std::make_unique<Session>(std::filesystem::path()); }

  void devicesAreFreeBeforeAndAfterALease() {
    QVERIFY(session_->areDevicesFree());
    {
      const DeviceLease lease = session_->leaseDevices(camera);
      QVERIFY(lease.isHeld() && !session_->areDevicesFree());
      QVERIFY(session_->devicesUser() == camera);
    }
    QVERIFY(session_->areDevicesFree() && session_->devicesUserName().isEmpty());
  }

  /// Whoever said that the room is clear has not looked since.
  void aConsentEndsWhereNothingIsDone() {
    using namespace std::chrono_literals;
    session_->setConsentTime(1ms);
    session_->setRoomClear(true);
    QVERIFY(session_->isRoomClear());
    {
      const DeviceLease lease = session_->leaseDevices(camera);
      session_->setRoomClear(true);
      QTest::qWait(20);
      QVERIFY(session_->isRoomClear());
    }
    QSignalSpy told(session_.get(), &Session::devicesChanged);
    QTRY_VERIFY(!session_->isRoomClear());
    QVERIFY(!told.isEmpty());
  }

  void nobodyElseIsLetToThem() {
    const DeviceLease lease = session_->leaseDevices(camera);
    QVERIFY_THROWS_EXCEPTION(std::logic_error, session_->leaseDevices(acquire));
    QVERIFY(session_->devicesUser() == camera);
  }

  void theyAreHeldWhereTheLeaseIsMovedTo() {
    DeviceLease held;
    {
      DeviceLease lease = session_->leaseDevices(camera);
      held = std::move(lease);
    }
    QVERIFY(held.isHeld() && session_->devicesUser() == camera);
    held.release();
    QVERIFY(!held.isHeld() && session_->areDevicesFree());
  }

  void aLeaseThatIsGivenUpTwiceDoesNotEndAnotherOne() {
    DeviceLease first = session_->leaseDevices(camera);
    first.release();
    const DeviceLease second = session_->leaseDevices(acquire);
    first.release();
    QVERIFY(session_->devicesUser() == acquire);
  }

  void itTellsBeginAndEnd() {
    QSignalSpy changed(session_.get(), &Session::devicesChanged);
    DeviceLease lease = session_->leaseDevices(camera);
    QCOMPARE(changed.size(), 1);
    lease.release();
    QCOMPARE(changed.size(), 2);
  }

  void aLeaseThatGoesAwayTellsLater() {
    QSignalSpy changed(session_.get(), &Session::devicesChanged);
    {
      const DeviceLease lease = session_->leaseDevices(camera);
    }
    QCOMPARE(changed.size(), 1);
    QVERIFY(session_->areDevicesFree());
    QTRY_COMPARE(changed.size(), 2);
  }

  void theSessionMayEndFirst() {
    DeviceLease lease = session_->leaseDevices(camera);
    session_.reset();
    QVERIFY(!lease.isHeld());
    lease.release();
  }

  void whoHoldsThemIsSaidInTheLanguageOfTheMoment() {
    const DeviceLease lease = session_->leaseDevices(acquire);
    QCOMPARE(session_->devicesUserName(), QString("Acquire"));
    Loud loud;
    QCoreApplication::installTranslator(&loud);
    QCOMPARE(session_->devicesUserName(), QString("ACQUIRE"));
    QCoreApplication::removeTranslator(&loud);
    QVERIFY(session_->devicesUser() == acquire);
  }
};

QTEST_GUILESS_MAIN(TestDeviceLease)
#include "test_device_lease.moc"
