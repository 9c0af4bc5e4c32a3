// SPDX-License-Identifier: MIT
// Another set of a calibration while a film plays: what the projector's window shows at the seam. Runs on two
// screens, see tests/support/with-two-screens.
#include <QTemporaryDir>
#include <QtTest>
#include <algorithm>
#include <ctime>
#include <filesystem>
#include <map>

#include "gui/output/scripted_renderer.h"
#include "gui/output/two_screens.h"
#include "output/engine_renderer.h"
#include "output/player.h"
#include "output/projector_window.h"
#include "relucent/calibration/calibration_folder.h"
#include "relucent/pipeline/calibrate.h"
#include "relucent/pipeline/sets.h"
#include "relucent/pipeline/stored_settings.h"

using namespace relucent;
using namespace relucent::engine;
using namespace relucent::gui;
using namespace relucent::pipeline;
using namespace std::chrono_literals;
namespace fs = std::filesystem;

namespace {

constexpr QSize contentSize(64, 48);
constexpr int pictures = 6;
constexpr double enoughTime = 1e9;  // for all steps, so that a frame does not depend on the machine

QImage contentOf(int number) {
  QImage image(contentSize, QImage::Format_RGBX8888);
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x)
      image.setPixelColor(
          x, y, QColor::fromHsv((23 * (x / 8) + 60 * number) % 360, 40 * (y / 8), 90 + 20 * ((x + y) / 16)));
  return image;
}

/// Six pictures in turn.
class Film : public ContentSource {
 public:
  ContentPicture at(ContentTime time) override {
    const auto step = static_cast<std::uint64_t>(time / 20ms);
    return {contentOf(static_cast<int>(step % pictures)), step + 1};
  }
  std::optional<ContentTime> length() const override { return std::nullopt; }
};

/// Gives every frame the time it needs, and lets preparing wait until frames were shown meanwhile.
class PatientRenderer : public FrameRenderer {
 public:
  explicit PatientRenderer(const RendererSettings& settings) : renderer_(settings, quiet_) {}
  std::vector<QSize> projectors() const override { return renderer_.projectors(); }
  Canvas canvas() const override { return renderer_.canvas(); }
  QString name() const override { return renderer_.name(); }
  RenderedFrame render(const ContentPicture& content, const RenderRequest& request,
                       const Outdated& outdated) override {
    RenderRequest patient = request;
    patient.seconds = enoughTime;
    ++rendered_;
    return renderer_.render(content, patient, outdated);
  }
  std::shared_ptr<PreparedSet> prepare(const std::string& set) override {
    const int until = rendered_ + 5;
    std::shared_ptr<PreparedSet> prepared = renderer_.prepare(set);
    while (rendered_ < until) std::this_thread::yield();
    return prepared;
  }
  void interrupt() override { renderer_.interrupt(); }

 private:
  Progress quiet_;
  EngineRenderer renderer_;
  std::atomic<int> rendered_{0};
};

/// What a thread has computed, whoever else the machine works for.
double threadSeconds() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

}  // namespace

class TestSetChange : public QObject {
  Q_OBJECT

  QTemporaryDir temporary_;
  fs::path venue() const { return fs::path(temporary_.path().toStdString()) / "corner"; }
  RendererSettings settingsFor(const std::string& set) const {
    RendererSettings settings{venue(), {contentSize, compensation::Fit::fit}};
    settings.backend = BackendChoice::cpu;
    settings.set = set;
    return settings;
  }
  /// As shows that were opened with that set have the pictures.
  std::vector<QImage> picturesBy(const std::string& set, bool compensated = true) const {
    Progress quiet;
    EngineRenderer renderer(settingsFor(set), quiet);
    RenderRequest request;
    request.seconds = enoughTime;
    request.compensated = compensated;
    std::vector<QImage> all;
    for (int number = 0; number < pictures; ++number)
      all.push_back(renderer.render({contentOf(number), static_cast<std::uint64_t>(number) + 1}, request, {})
                        .drives.at(0)
                        .image()
                        .convertToFormat(QImage::Format_RGB32));
    return all;
  }

 private slots:
  void initTestCase() {
    Progress quiet;
    CalibrateSettings settings;
    venue::VenueSettings corner;
    corner.name = "corner";
    corner.projector = {40, 30};
    corner.camera = {28, 21};
    corner.pathsPerPixel = 32;
    settings.rig = corner;
    settings.linearization.levels = 9;
    calibrate(venue(), settings, temporary_.path().toStdString() + "/cache", quiet);
    auto folder =
        calibration::CalibrationFolder::open(venue(), calibration::CalibrationFolder::Access::write);
    saveSet(folder, "day");
    saveSet(folder, "night");
    CalibrateSettings night = settingsOf(folder);
    night.content.reachablePercentile = 1.0;
    night.content.masks = {{0, compensation::Outline::lines, {{0.4, 0.3}, {0.7, 0.3}, {0.7, 0.7}}, 0.05}};
    changeSettings(folder, night);
    useSet(folder, "day");
  }

  /// Law: every picture on the wall is one that a show of the old set has, or one that a show of the new set
  /// has, and after the first of the new there is none of the old.
  void noFrameIsDarkOrOfNeither() {
    const std::map<std::string, std::vector<QImage>> by{{"day", picturesBy("day")},
                                                        {"night", picturesBy("night")}};
    const std::vector<QImage> uncorrected = picturesBy("day", false);
    const auto has = [](const std::vector<QImage>& all, const QImage& one) {
      return std::ranges::find(all, one) != all.end();
    };
    for (const QImage& picture : by.at("day"))
      QVERIFY(!has(by.at("night"), picture) && !has(uncorrected, picture) && !allBlack(picture));
    for (const QImage& picture : by.at("night")) QVERIFY(!allBlack(picture));

    ProjectorWindow window(projector);
    window.shine();
    QTRY_VERIFY(window.isExposed());
    Player player(std::make_unique<PatientRenderer>(settingsFor({})), std::make_shared<Film>(), {&window});
    QStringList changes;
    connect(&player, &Player::setShown, this,
            [&](const std::string& name) { changes.append(QString::fromStdString(name)); });
    player.start();
    const QPoint corner((projectorSize.width() - 40) / 2, (projectorSize.height() - 30) / 2);
    QScreen* screen = screenOn("DUMMY1");
    const auto seen = [&] {
      return screen->grabWindow(0, corner.x(), corner.y(), 40, 30)
          .toImage()
          .convertToFormat(QImage::Format_RGB32);
    };
    QTRY_VERIFY(has(by.at("day"), seen()));

    double longest = 0.0;
    int photographs = 0;
    std::string before = "day";
    for (const std::string wanted : {"night", "day", "night"}) {
      const qsizetype known = changes.size();
      player.useSet(wanted);
      bool isNew = false;
      for (int after = 0; after < 20; after += isNew ? 1 : 0) {
        const double begun = threadSeconds();
        QCoreApplication::processEvents();
        longest = std::max(longest, threadSeconds() - begun);
        const QImage now = seen();
        ++photographs;
        if (!isNew) isNew = has(by.at(wanted), now);
        QVERIFY2(has(by.at(isNew ? wanted : before), now),
                 qPrintable(QString("photograph %1 is of %2")
                                .arg(photographs)
                                .arg(has(by.at(before), now) ? "the old set again"
                                     : has(uncorrected, now) ? "what is not corrected"
                                                             : "neither set")));
        QVERIFY(photographs < 20000);
      }
      QCOMPARE(changes.size(), known + 1);
      QCOMPARE(changes.back().toStdString(), wanted);
      before = wanted;
    }
    qInfo("%d photographs, GUI thread at most %.1f ms at once", photographs, 1e3 * longest);
    QVERIFY2(longest < 0.1, qPrintable(QString("%1 s").arg(longest)));
    player.stop();
  }
};

QTEST_MAIN(TestSetChange)
#include "test_set_change.moc"
