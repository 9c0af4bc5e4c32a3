// SPDX-License-Identifier: MIT
#include <QtTest>
#include <deque>
#include <numeric>

#include "relucent/base/error.h"
#include "relucent/devices/check/screen_proof.h"
#include "support/scripted_rig.h"
#include "support/sentences.h"
#include "support/stopped.h"

using namespace relucent;
using namespace relucent::devices;
using namespace relucent::image;
using namespace relucent::rig;
using namespace relucent::transport;
using namespace relucent::test;

namespace {

/// What lies between a program and the wall.
struct Way {
  bool mirroredX = false, mirroredY = false;
  bool asleep = false;
  int late = 0;  // pictures
};

class WaywardProjector : public Projector {
 public:
  WaywardProjector(std::unique_ptr<Projector> projector, Way way, std::string name)
      : projector_(std::move(projector)), way_(way), name_(std::move(name)) {}

  std::string name() const override { return name_; }
  Size size() const override { return projector_->size(); }
  int bits() const override { return projector_->bits(); }
  void show(const Image& picture) override {
    Image onWall(size(), 3, 0.0f);
    for (int y = 0; y < size().height && !way_.asleep; ++y)
      for (int x = 0; x < size().width; ++x)
        for (int c = 0; c < 3; ++c)
          onWall.at(x, y, c) = picture.at(way_.mirroredX ? size().width - 1 - x : x,
                                          way_.mirroredY ? size().height - 1 - y : y, c);
    under_.push_back(onWall);
    if (under_.size() <= static_cast<std::size_t>(way_.late)) return;
    projector_->show(under_.front());
    under_.pop_front();
  }

 private:
  std::unique_ptr<Projector> projector_;
  Way way_;
  std::string name_;
  std::deque<Image> under_;
};

/// A camera before two projectors, "left" and "right".
Rig rigOf(Way left, Way right, double flicker = 0.0, std::uint64_t seed = 1,
          std::function<void(const CaptureRequest&)> beforeCapture = {}) {
  SyntheticSettings synthetic;
  synthetic.projectors = {{30, 22}, {17, 13}};
  synthetic.cameras = {{41, 29}};
  synthetic.interreflection = 0.3;
  synthetic.seed = seed;
  TransportMatrix transport = syntheticTransport(synthetic);
  ScriptedSettings scripted;
  scripted.flicker = flicker;
  scripted.seed = seed;
  scripted.beforeCapture = std::move(beforeCapture);
  const CameraStack black = syntheticBlack(transport);
  Rig rig = ScriptedVenue(std::move(transport), black, scripted).rig();
  rig.projectors[0] = std::make_unique<WaywardProjector>(std::move(rig.projectors[0]), left, "left");
  rig.projectors[1] = std::make_unique<WaywardProjector>(std::move(rig.projectors[1]), right, "right");
  for (auto& projector : rig.projectors) projector->show(Image(projector->size(), 3, 0.0f));
  return rig;
}

double exposure(Projector&) {
  return 0.02;
}

ScreenProof proved(Rig& rig, const ScreenProofSettings& settings = {}) {
  Progress silent;
  return proveScreen(*rig.projectors[0], {rig.projectors[1].get()}, *rig.cameras[0], exposure, settings,
                     silent);
}

}  // namespace

class TestScreenProof : public QObject {
  Q_OBJECT

 private slots:
  /// So are the shifts by which the quarters and late pictures are told apart.
  void theCodeHasTheCorrelationOfItsKind() {
    std::vector<int> bits;
    for (int i = 0; i < screenCodeLength; ++i)
      bits.push_back(screenCode({8, 8}, i).at(0, 0, 0) > 0.5f ? 1 : -1);
    QCOMPARE(std::accumulate(bits.begin(), bits.end(), 0), 1);
    for (std::size_t shift = 1; shift < screenCodeLength; ++shift) {
      int sum = 0;
      for (std::size_t i = 0; i < screenCodeLength; ++i)
        sum += bits[i] * bits[(i + shift) % screenCodeLength];
      QCOMPARE(sum, -1);
    }
  }

  void whatTheCameraSeesIsTold_data() {
    QTest::addColumn<Way>("left");
    QTest::addColumn<Way>("right");
    QTest::addColumn<bool>("seen");
    QTest::addColumn<bool>("mirrored");
    QTest::addColumn<QByteArray>("instead");
    const Way straight, dark{false, false, true, 0};
    QTest::newRow("straight") << straight << straight << true << false << QByteArray();
    QTest::newRow("mirrored") << Way{true, false, false, 0} << straight << true << true << QByteArray();
    QTest::newRow("upside down") << Way{false, true, false, 0} << straight << true << true << QByteArray();
    QTest::newRow("turned") << Way{true, true, false, 0} << straight << true << false << QByteArray();
    QTest::newRow("the other") << dark << straight << false << false << QByteArray("right");
    QTest::newRow("neither") << dark << dark << false << false << QByteArray();
  }
  void whatTheCameraSeesIsTold() {
    QFETCH(Way, left);
    QFETCH(Way, right);
    QFETCH(bool, seen);
    QFETCH(bool, mirrored);
    QFETCH(QByteArray, instead);
    for (std::uint64_t seed : {1u, 2u, 3u}) {
      Rig rig = rigOf(left, right, 0.02, seed);
      const ScreenProof proof = proved(rig);
      QCOMPARE(proof.isSeen, seen);
      QCOMPARE(proof.sight.mirrored, mirrored);
      QCOMPARE(proof.instead, instead.toStdString());
      QCOMPARE(mentions(english(messageOf(proof.verdicts.back())), "mirrored"), mirrored);
      if (seen) {
        requireSeen(proof, *rig.projectors[0], *rig.cameras[0]);
        continue;
      }
      const std::string sentence =
          sentenceOf([&] { requireSeen(proof, *rig.projectors[0], *rig.cameras[0]); }, ErrorKind::device);
      QVERIFY(mentions(sentence, instead.isEmpty() ? "does not see what is shown on left"
                                                   : "the camera sees right, not left"));
    }
  }

  void picturesThatComeLateAreRecognised_data() {
    QTest::addColumn<int>("late");
    for (int late : {0, 1, 2, 5}) QTest::addRow("%d", late) << late;
  }
  void picturesThatComeLateAreRecognised() {
    QFETCH(int, late);
    Rig rig = rigOf({false, false, false, late}, {});
    ScreenProofSettings settings;
    settings.mostLate = 5;
    const ScreenProof proof = proved(rig, settings);
    QVERIFY(proof.isSeen);
    QCOMPARE(proof.sight.late, late);
    QCOMPARE(messageOf(proof.verdicts.back()).id() == "check.pictures-late", late > 0);
  }

  /// A camera that sees no light is given the longest exposure: so few of these as can be. Another screen has
  /// one of its own.
  void noCodeIsPhotographedInTheDarkForLong() {
    int longOnes = 0, shortOnes = 0;
    Rig rig = rigOf({false, false, true, 0}, {}, 0.0, 1,
                    [&](const CaptureRequest& request) { ++(request.seconds > 0.5 ? longOnes : shortOnes); });
    Progress silent;
    const ScreenProof proof = proveScreen(
        *rig.projectors[0], {rig.projectors[1].get()}, *rig.cameras[0],
        [](Projector& screen) { return screen.name() == "left" ? 1.0 : 0.02; }, {}, silent);
    QVERIFY(!proof.isSeen);
    QCOMPARE(proof.instead, std::string("right"));
    QCOMPARE(longOnes, 2 * (ScreenProofSettings().mostLate + 1));
    QCOMPARE(shortOnes, screenCodeLength + ScreenProofSettings().mostLate);
  }

  /// Light that comes late or is dim is still light.
  void longExposuresSeeTheCodeToo_data() { picturesThatComeLateAreRecognised_data(); }
  void longExposuresSeeTheCodeToo() {
    QFETCH(int, late);
    Rig rig = rigOf({false, false, false, late}, {});
    ScreenProofSettings settings;
    settings.mostLate = 5;
    Progress silent;
    const ScreenProof proof = proveScreen(
        *rig.projectors[0], {}, *rig.cameras[0], [](Projector&) { return 0.5; }, settings, silent);
    QVERIFY(proof.isSeen);
    QCOMPARE(proof.sight.late, late);
    QCOMPARE(proof.exposure, 0.5);
  }

  /// Nothing that blinks, moves or stands still is taken for the code.
  void nothingElseIsTakenForTheCode_data() {
    QTest::addColumn<int>("kind");
    const char* names[]{"black", "white", "not a number", "blinking", "brightening", "noise"};
    for (int kind = 0; kind < 6; ++kind) QTest::newRow(names[kind]) << kind;
  }
  void nothingElseIsTakenForTheCode() {
    QFETCH(int, kind);
    const ScreenProofSettings settings;
    for (Size size : {Size{1, 1}, Size{13, 7}}) {
      std::vector<Image> photographs;
      quint32 state = 7;
      for (int i = 0; i < screenCodeLength + settings.mostLate; ++i) {
        Image photograph(size, 3, 0.0f);
        for (float& value : photograph.data()) {
          state = state * 1664525u + 1013904223u;
          const float random = static_cast<float>(state >> 8) / 16777216.0f;
          const float of[]{
              0.0f, 1.0f, std::nanf(""), static_cast<float>(i % 2), 0.02f * static_cast<float>(i), random};
          value = of[kind];
        }
        photographs.push_back(std::move(photograph));
      }
      QVERIFY(sightOf(photographs, settings).share < settings.leastShare);
    }
  }

  void stoppingStops() {
    Rig rig = rigOf({}, {});
    Stopped stopped;
    QVERIFY_THROWS_EXCEPTION(Cancelled,
                             proveScreen(*rig.projectors[0], {}, *rig.cameras[0], exposure, {}, stopped));
  }

  void problemsAreListed() {
    ScreenProofSettings settings;
    settings.mostLate = 8;
    settings.explained = 1.0;
    settings.leastShare = 0.0;
    QCOMPARE(problems(settings).size(), std::size_t{3});
    QVERIFY(problems(ScreenProofSettings()).empty());
  }
};

QTEST_GUILESS_MAIN(TestScreenProof)
#include "test_screen_proof.moc"
