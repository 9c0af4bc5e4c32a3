// SPDX-License-Identifier: MIT
// Which part of a projector's picture a camera sees.
#include "relucent/linearization/coverage.h"

#include <QtTest>
#include <algorithm>
#include <cmath>

using namespace relucent;
using namespace relucent::image;
using namespace relucent::linearization;
using namespace relucent::rig;

namespace {

constexpr Size picture{96, 64}, view{96, 64};

/// Remembers what it shows.
class Screen : public Projector {
 public:
  explicit Screen(Image& shown) : shown_(shown) {}
  std::string name() const override { return "screen"; }
  Size size() const override { return picture; }
  int bits() const override { return 8; }
  void show(const Image& drive) override { shown_ = drive; }

 private:
  Image& shown_;
};

/// Looks at the screens side by side, `aside` columns further to the right and `below` rows further down than
/// would show the first one whole. All pixels see some of all light as well, more of one place than of
/// another, and some that is always there.
class Eye : public Camera {
 public:
  Eye(const std::vector<Image>& shown, int aside, int below, float scattered)
      : shown_(shown), aside_(aside), below_(below), scattered_(scattered) {}
  std::string name() const override { return "eye"; }
  Size size() const override { return view; }
  ExposureRange exposures() const override { return {0.01, 1.0}; }
  RawFrame capture(const CaptureRequest& request) override {
    double all = 0.0;
    for (const Image& screen : shown_)
      for (std::size_t i = 0; i < screen.pixels(); ++i) {
        const Pixel place = pixelAt(picture, i);
        const double weight = place.x < 6 && place.y < 4 ? 20.0 : 1.0;
        all += weight * static_cast<double>(screen.pixel(i)[0]) / static_cast<double>(screen.pixels());
      }
    Image signal(view, 3, 0.05f + scattered_ * static_cast<float>(all));
    for (int y = 0; y < view.height; ++y)
      for (int x = 0; x < view.width; ++x) {
        const int column = x + aside_, row = y + below_;
        const auto screen = static_cast<std::size_t>(column / picture.width);
        if (column < 0 || row >= picture.height || screen >= shown_.size()) continue;
        for (std::size_t c = 0; c < 3; ++c)
          signal.pixel(indexOf(view, {x, y}))[c] +=
              0.6f * shown_[screen].pixel(indexOf(picture, {column % picture.width, row}))[c];
      }
    return {signal, 12, request.seconds};
  }

 private:
  const std::vector<Image>& shown_;
  int aside_, below_;
  float scattered_;
};

struct Setting {
  std::vector<Image> shown;
  Rig rig;
  Setting(std::size_t projectors, int aside, int below, float scattered)
      : shown(projectors, Image(picture, 3)) {
    for (Image& screen : shown) rig.projectors.push_back(std::make_unique<Screen>(screen));
    addCamera(aside, below, scattered);
  }
  void addCamera(int aside, int below, float scattered) {
    rig.cameras.push_back(std::make_unique<Eye>(shown, aside, below, scattered));
  }
  RigCoverage lookWithAll() {
    NoShotLog log;
    ShotTaker taker(rig, log, "coverage");
    Progress quiet;
    RigCoverage seen = coverageOf(taker, 0.1, quiet);
    photographs = taker.shots();
    return seen;
  }
  /// Of the first camera.
  std::vector<Coverage> look() {
    std::vector<Coverage> first;
    for (const std::vector<Coverage>& cameras : lookWithAll().coverages) first.push_back(cameras.front());
    return first;
  }
  int photographs = 0;
};

}  // namespace

class TestCoverage : public QObject {
  Q_OBJECT

 private slots:
  /// Law: the share is that of the picture within the view, to half a cell, and edges out of sight are named,
  /// however much light is scattered.
  void theShareIsWhatIsInView_data() {
    QTest::addColumn<int>("aside");
    QTest::addColumn<int>("below");
    QTest::addColumn<float>("scattered");
    for (float scattered : {0.0f, 0.6f}) {
      QTest::addRow("all, scattered %.2f", static_cast<double>(scattered)) << 0 << 0 << scattered;
      QTest::addRow("a quarter at the left missing, scattered %.2f", static_cast<double>(scattered))
          << 24 << 0 << scattered;
      QTest::addRow("half at the top missing, scattered %.2f", static_cast<double>(scattered))
          << 0 << 32 << scattered;
      QTest::addRow("a corner left, scattered %.2f", static_cast<double>(scattered)) << 72 << 48 << scattered;
    }
  }
  void theShareIsWhatIsInView() {
    QFETCH(int, aside);
    QFETCH(int, below);
    QFETCH(float, scattered);
    const Coverage coverage = Setting(1, aside, below, scattered).look().front();
    const double truth = (1.0 - aside / 96.0) * (1.0 - below / 64.0);
    const double cell = 0.5 / coverage.cells.width + 0.5 / coverage.cells.height;
    QVERIFY2(std::abs(coverage.share() - truth) <= cell, qPrintable(QString::number(coverage.share())));
    QCOMPARE(coverage.missingLeft() > 0.9, aside > 0);
    QCOMPARE(coverage.missingTop() > 0.9, below > 0);
    // Nothing is seen by what it scatters alone.
    const Size cells = coverage.cells;
    for (std::size_t i = 0; i < coverage.seen.size(); ++i) {
      const Pixel at = pixelAt(cells, i);
      if ((at.x + 1) * picture.width <= aside * cells.width ||
          (at.y + 1) * picture.height <= below * cells.height)
        QCOMPARE(int{coverage.seen[i]}, 0);
    }
    // The other edges are in view as far as the picture is.
    QVERIFY(std::abs(coverage.missingRight() - below / 64.0) <= cell + 1e-9);
    QVERIFY(std::abs(coverage.missingBottom() - aside / 96.0) <= cell + 1e-9);
  }

  /// Law: each projector's own picture is judged, not the light of the others.
  void everyProjectorIsJudgedAlone() {
    const std::vector<Coverage> both = Setting(2, 96, 0, 0.1f).look();
    QCOMPARE(both.size(), std::size_t{2});
    QCOMPARE(both[0].share(), 0.0);
    QVERIFY(both[1].share() > 0.95);
  }

  /// Law: a camera sees what it would see alone, of the same photographs; together they see what either does.
  void camerasShareThePhotographs() {
    Setting left(2, 24, 0, 0.1f), right(2, 72, 0, 0.1f), both(2, 24, 0, 0.1f);
    both.addCamera(72, 0, 0.1f);
    const RigCoverage alone[]{left.lookWithAll(), right.lookWithAll()}, seen = both.lookWithAll();
    QCOMPARE(both.photographs, left.photographs);
    const std::vector<Coverage> any = seen.byAnyCamera();
    for (std::size_t projector = 0; projector < 2; ++projector) {
      for (std::size_t camera = 0; camera < 2; ++camera) {
        QCOMPARE(seen.coverages[projector][camera].seen, alone[camera].coverages[projector][0].seen);
        QCOMPARE(seen.litBy[camera], alone[camera].litBy[0]);
      }
      for (std::size_t cell = 0; cell < any[projector].seen.size(); ++cell)
        QCOMPARE(any[projector].seen[cell] != 0, seen.coverages[projector][0].seen[cell] != 0 ||
                                                     seen.coverages[projector][1].seen[cell] != 0);
    }
    QVERIFY(any[0].share() > seen.coverages[0][1].share());
  }

  /// Law: shares of what is lit sum to one; screens side by side do not overlap, those that fall on each
  /// other do everywhere.
  void overlapsAreCounted() {
    const RigCoverage seen = Setting(2, 48, 0, 0.0f).lookWithAll();
    QCOMPARE(seen.overlaps(0), (std::vector<double>{1.0, 0.0}));
    // Without a gap, at the edges of cells neither.
    for (std::size_t i = 0; i < view.count(); ++i)
      QCOMPARE(seen.litBy[0][i], pixelAt(view, i).x < 48 ? std::uint32_t{1} : std::uint32_t{2});
    RigCoverage onEachOther;
    onEachOther.coverages.resize(3);
    onEachOther.litBy = {{0b001, 0b011, 0b000, 0b111}};
    QCOMPARE(onEachOther.overlaps(0), (std::vector<double>{1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0}));
    onEachOther.litBy = {{0, 0}};
    QVERIFY(onEachOther.overlaps(0).empty());
  }
};

QTEST_APPLESS_MAIN(TestCoverage)
#include "test_coverage.moc"
