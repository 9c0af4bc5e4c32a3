// SPDX-License-Identifier: MIT
// The choice between several devices, on a page that has them and on one that has not.
#include "wizard/devices/device_selector.h"

#include <QTemporaryDir>
#include <QVBoxLayout>
#include <QtTest>

using namespace relucent;
using namespace relucent::gui;
using namespace relucent::pipeline;
using namespace relucent::venue;

namespace {

class ScriptedPage : public DevicePage {
 public:
  explicit ScriptedPage(Session& session) : DevicePage({"page", "", "page"}, session) {}
  QString subtitle() const override { return {}; }
  StepStatus status() const override { return {}; }
  PageCommand* primary() const override { return nullptr; }
};

}  // namespace

class TestDeviceSelector : public QObject {
  Q_OBJECT

  QTemporaryDir folder_;
  std::unique_ptr<Session> session_;
  std::unique_ptr<ScriptedPage> page_;

  void begin(const char* venue) {
    VenueSettings rig;
    rig.name = venue;
    CalibrateSettings settings;
    settings.rig = rig;
    session_->begin(folder_.filePath(venue).toStdString(), settings);
  }

 private slots:
  void init() {
    session_ = std::make_unique<Session>(std::filesystem::path());
    page_ = std::make_unique<ScriptedPage>(*session_);
    // As pages do.
    connect(session_.get(), &Session::stepsChanged, page_.get(), &PageModel::settingsChanged);
  }
  void cleanup() {
    page_.reset();
    session_.reset();
    QDir(folder_.path()).removeRecursively();
    QDir().mkpath(folder_.path());
  }

  void itIsThereWhereThereIsAChoice() {
    QWidget window;
    auto* column = new QVBoxLayout(&window);
    auto* projector = new DeviceSelector(DeviceSelector::Kind::projector, *page_, &window);
    auto* camera = new DeviceSelector(DeviceSelector::Kind::camera, *page_, &window);
    column->addWidget(projector);
    column->addWidget(camera);
    QVERIFY(!projector->isVisible());  // no window of its own, whatever is open
    window.show();
    QVERIFY(!projector->isVisible() && !camera->isVisible());
    begin("relief");
    QVERIFY(projector->isVisible() && !camera->isVisible());
    QCOMPARE(projector->count(), 2);
    QCOMPARE(projector->itemText(1), DeviceSelector::tr("Projector %1").arg(2));
    QCOMPARE(projector->accessibleName(), DeviceSelector::tr("Projector that is shown"));
    begin("plain");
    QVERIFY(!projector->isVisible());
  }

  void theKeyboardReachesItAndChooses() {
    begin("relief");
    QWidget window;
    auto* column = new QVBoxLayout(&window);
    auto* projector = new DeviceSelector(DeviceSelector::Kind::projector, *page_, &window);
    column->addWidget(projector);
    window.show();
    QVERIFY(projector->focusPolicy() & Qt::TabFocus);
    QTest::keyClick(projector, Qt::Key_Down);
    QCOMPARE(page_->projector(), std::size_t{1});
    QTest::keyClick(projector, Qt::Key_Up);
    QCOMPARE(page_->projector(), std::size_t{0});
  }

  void allThatAreOfOnePageShowTheSame() {
    begin("relief");
    QWidget window;
    DeviceSelector one(DeviceSelector::Kind::projector, *page_, &window);
    DeviceSelector other(DeviceSelector::Kind::projector, *page_, &window);
    page_->showProjector(1);
    QCOMPARE(one.currentIndex(), 1);
    QTest::keyClick(&other, Qt::Key_Up);
    QCOMPARE(one.currentIndex(), 0);
    QCOMPARE(page_->projector(), std::size_t{0});
    page_->showProjector(1);
    session_->close();
    QCOMPARE(one.count(), 1);
    QCOMPARE(one.currentIndex(), 0);
  }
};

QTEST_MAIN(TestDeviceSelector)
#include "test_device_selector.moc"
