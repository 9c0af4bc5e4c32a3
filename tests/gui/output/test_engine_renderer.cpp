// SPDX-License-Identifier: MIT
// What a show sends to its projectors against what the pipeline computes, on a small simulated venue.
#include "output/engine_renderer.h"

#include <QTemporaryDir>
#include <QtTest>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "content/still_image.h"
#include "relucent/calibration/calibration_folder.h"
#include "relucent/image/picture_files.h"
#include "relucent/pipeline/calibrate.h"
#include "relucent/pipeline/compensate.h"
#include "relucent/pipeline/perfected.h"
#include "relucent/pipeline/pictures.h"
#include "relucent/pipeline/proof_record.h"
#include "support/sentences.h"

using namespace relucent;
using namespace relucent::compensation;
using namespace relucent::engine;
using namespace relucent::gui;
using namespace relucent::image;
using namespace relucent::pipeline;
using namespace relucent::venue;
namespace fs = std::filesystem;

namespace {

constexpr Size contentSize{64, 48};

/// Saturated and dark colours: where the light of one camera pixel has more than one colour mixing they tell.
/// `share`: of their brightness.
QImage colours(double share = 1.0) {
  QImage image(contentSize.width, contentSize.height, QImage::Format_RGBX8888);
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x)
      image.setPixelColor(x, y,
                          QColor::fromHsv((23 * (x / 8)) % 360, 40 * (y / 8),
                                          static_cast<int>(share * (60 + 24 * ((x + y) / 16)))));
  return image;
}

}  // namespace

class TestEngineRenderer : public QObject {
  Q_OBJECT

  QTemporaryDir temporary_;
  fs::path root() const { return temporary_.path().toStdString(); }

  RendererSettings settingsOf(const char* venue, const std::vector<Position>& cameras = {}) {
    RendererSettings settings{root() / venue, {{contentSize.width, contentSize.height}, Fit::fit}};
    settings.backend = BackendChoice::cpu;
    settings.cameras = cameras;
    return settings;
  }
  RenderedFrame rendered(const char* venue, const Outdated& outdated,
                         std::optional<Brightness> brightness = {}, double share = 1.0) {
    Progress silent;
    RendererSettings settings = settingsOf(venue);
    settings.brightness = brightness;
    EngineRenderer renderer(settings, silent);
    RenderRequest request;
    request.thorough = true;
    return renderer.render({colours(share), 1}, request, outdated);
  }
  /// The pipeline's drive by the same method, as a picture.
  Image compensated(const char* venue, Brightness brightness) {
    Progress silent;
    colours().save(QString::fromStdString((root() / "colours.png").string()));
    CompensateSettings settings;
    settings.image = root() / "colours.png";
    settings.out = root() / (std::string(venue) + "-out");
    settings.target = targetOf(ContentSettings());
    settings.target.brightness = brightness;
    compensate(root() / venue, settings, silent);
    return readPicture(settings.out / "pattern.png").encoded;
  }

 private slots:
  void initTestCase() {
    Progress silent;
    for (const char* name : {"corner", "plain", "statue3"}) {
      VenueSettings venue;
      venue.name = name;
      venue.projector = {40, 30};
      venue.camera = {28, 21};
      venue.pathsPerPixel = 32;
      CalibrateSettings settings;
      settings.rig = venue;
      settings.linearization.levels = 9;
      calibrate(root() / name, settings, root() / "cache", silent);
    }
  }

  void aPictureThatStandsIsThePipelines_data() {
    QTest::addColumn<QString>("venue");
    QTest::addColumn<int>("brightness");
    for (const char* venue : {"corner", "plain"})
      for (Brightness brightness : allValues<Brightness>())
        QTest::addRow("%s, %s", venue, std::string(nameOf(brightness)).c_str())
            << venue << static_cast<int>(brightness);
  }
  void aPictureThatStandsIsThePipelines() {
    QFETCH(QString, venue);
    QFETCH(int, brightness);
    QByteArray name = venue.toUtf8();
    const auto way = static_cast<Brightness>(brightness);
    RenderedFrame frame = rendered(name, [] { return false; }, way);
    Image wanted = compensated(name, way);
    QCOMPARE(frame.drives.size(), std::size_t{1});
    QCOMPARE(frame.drives[0].size(), QSize(wanted.width(), wanted.height()));
    const QImage drive = frame.drives[0].image();
    // The one is the nearest code, the other one of the two about the same light.
    for (int y = 0; y < wanted.height(); ++y)
      for (int x = 0; x < wanted.width(); ++x)
        for (int c = 0; c < 3; ++c) {
          int code = drive.constScanLine(y)[4 * x + c];
          QVERIFY2(std::abs(code - std::lround(255.0f * wanted.at(x, y, c))) <= 1,
                   qPrintable(QString("%1, %2: %3").arg(x).arg(y).arg(code)));
        }
  }

  /// Whoever stands at a camera, or between them, has what the pipeline solves for him there; and when he has
  /// gone, all have what they had.
  void aViewerIsFollowed() {
    Progress silent;
    const std::vector<Position> places{{-1, 0, 0}, {0, 1, 0}, {1, 0, 0}};
    EngineRenderer renderer(settingsOf("statue3", places), silent);
    QVERIFY(renderer.cameras() == places);
    const Outdated needed = [] { return false; };
    RenderRequest request;
    request.seconds = 1e9;  // all steps
    const RenderedFrame home = renderer.render({colours(), 1}, request, needed);
    request.thorough = true;
    const RenderedFrame best = renderer.render({colours(), 1}, request, needed);

    CompensateSettings settings;
    settings.image = root() / "colours.png";
    settings.out = root() / "viewer-out";
    colours().save(QString::fromStdString(settings.image.string()));
    settings.target = targetOf(ContentSettings());
    for (const Position& place : places) settings.target.views.push_back({1.0, {}, {}, place});
    for (const Position& viewer : {Position{1, 0, 0}, Position{0.4, 0.5, 0.0}}) {
      request.viewer = FrameViewer{viewer, 1.0};
      const std::vector<double> weights = viewerWeights(places, viewer);
      for (std::size_t view = 0; view < places.size(); ++view)
        settings.target.views[view].weight = std::max(weights[view], 1e-3 / 3.0);
      compensate(root() / "statue3", settings, silent);
      // From what was there before, step by step, as nearly as it can be had in haste; then as well as
      // possible.
      request.thorough = false;
      QVERIFY(renderer.render({colours(), 1}, request, needed).drives[0].image() != best.drives[0].image());
      request.thorough = true;
      const RenderedFrame frame = renderer.render({colours(), 1}, request, needed);
      for (std::size_t projector = 0; projector < 2; ++projector) {
        const Image wanted =
            readPicture(settings.out / (projector == 0 ? "pattern.png" : "pattern-2.png")).encoded;
        const QImage drive = frame.drives[projector].image();
        for (int y = 0; y < wanted.height(); ++y)
          for (int x = 0; x < wanted.width(); ++x)
            for (int c = 0; c < 3; ++c)
              QVERIFY(std::abs(drive.constScanLine(y)[4 * x + c] -
                               std::lround(255.0f * wanted.at(x, y, c))) <= 1);
      }
    }
    request.viewer.reset();
    QVERIFY(renderer.render({colours(), 1}, request, needed).drives[0].image() == best.drives[0].image());
    request.thorough = false;
    QVERIFY(renderer.render({colours(), 2}, request, needed).drives[0].image() == home.drives[0].image());
  }

  /// A picture that was perfected is shown so when it stands, and only as it was perfected.
  void aPerfectedPictureIsShown() {
    const QString file = QString::fromStdString((root() / "perfected.png").string());
    colours().save(file);
    const Canvas canvas = settingsOf("plain").canvas;
    const ContentPicture content = StillImage(file, canvas).at({});
    QVERIFY(!content.identity.empty());
    std::string shownFrom;
    {
      const auto folder = calibration::CalibrationFolder::open(root() / "plain",
                                                               calibration::CalibrationFolder::Access::read);
      shownFrom = fingerprintOfShown(folder);
    }
    const Size projector{40, 30};
    savePerfected(
        {perfectedKey(shownFrom, content.identity), root() / "plain", file.toStdString(), "now", {}, {}},
        ProjectorStack(3 * projector.count(), 0.5f), Rasters(projector));
    const Outdated needed = [] { return false; };
    RenderRequest request;
    const auto isPerfected = [&](RendererSettings settings, const ContentPicture& picture) {
      std::vector<Message> warnings;
      Progress silent;
      EngineRenderer renderer(settings, silent, [&](const Message& warning) { warnings.push_back(warning); });
      const RenderedFrame frame = renderer.render(picture, request, needed);
      const QImage drive = frame.drives[0].image();
      const QRgb first = drive.pixel(0, 0);
      bool even = true;  // one drive all over, but for dither
      for (int y = 0; y < drive.height(); ++y)
        for (int x = 0; x < drive.width(); ++x)
          even &= std::abs(qGreen(drive.pixel(x, y)) - qGreen(first)) <= 1;
      return frame.perfected && even && warnings.empty();
    };
    QVERIFY(!isPerfected(settingsOf("plain"), content));  // in haste
    request.thorough = true;
    QVERIFY(isPerfected(settingsOf("plain"), content));
    QVERIFY(!isPerfected(settingsOf("corner"), content));                // another venue
    QVERIFY(!isPerfected(settingsOf("plain"), {content.image, 1, {}}));  // another picture that looks alike
    RendererSettings other = settingsOf("plain");
    other.brightness = Brightness::region;
    QVERIFY(!isPerfected(other, content));
    other = settingsOf("plain");
    other.adaptiveRange = true;
    QVERIFY(!isPerfected(other, content));
    request.compensated = false;
    QVERIFY(!isPerfected(settingsOf("plain"), content));
  }
  /// One that is damaged is told of, and the picture is shown as T has it.
  void aDamagedPerfectedPictureIsToldOf() {
    const QString file = QString::fromStdString((root() / "damaged.png").string());
    colours().save(file);
    const ContentPicture content = StillImage(file, settingsOf("corner").canvas).at({});
    {
      const auto folder = calibration::CalibrationFolder::open(root() / "corner",
                                                               calibration::CalibrationFolder::Access::read);
      const fs::path record = perfectedFolder(root() / "corner") /
                              perfectedKey(fingerprintOfShown(folder), content.identity) / "perfected.json";
      fs::create_directories(record.parent_path());
      std::ofstream(record) << "{";
    }
    std::vector<Message> warnings;
    Progress silent;
    EngineRenderer renderer(settingsOf("corner"), silent,
                            [&](const Message& warning) { warnings.push_back(warning); });
    RenderRequest request;
    request.thorough = true;
    for (int again = 0; again < 2; ++again) {
      const RenderedFrame frame = renderer.render(content, request, [] { return false; });
      QVERIFY(!frame.perfected && frame.drives.size() == 1);
    }
    QCOMPARE(warnings.size(), 1u);
    QVERIFY(mentions(englishSentence(warnings.front()), "the record of a perfected picture cannot be read"));
  }

  void positionsOfOtherCamerasAreRefused() {
    Progress silent;
    const auto sentence = sentenceOf(
        [&] { EngineRenderer(settingsOf("statue3", {{0, 0, 0}, {1, 0, 0}}), silent); }, ErrorKind::input);
    QVERIFY(mentions(sentence, "2 positions are given, and the calibration has 3 cameras"));
  }

  /// Law: the engine's frames have the gains that the picture that stands has, and a range of its own that
  /// goes with the content takes their place.
  void framesInHasteHaveTheSameWhite() {
    const Outdated outdated = [] { return true; }, needed = [] { return false; };
    // Mean distance of codes: how far a frame in haste is from the solution, and one white from another.
    const auto apart = [](const RenderedFrame& a, const RenderedFrame& b) {
      const QImage one = a.drives[0].image(), other = b.drives[0].image();
      double sum = 0.0;
      for (int y = 0; y < one.height(); ++y)
        for (int x = 0; x < one.width(); ++x)
          for (int c = 0; c < 3; ++c)
            sum += std::abs(one.constScanLine(y)[4 * x + c] - other.constScanLine(y)[4 * x + c]);
      return sum / (3.0 * one.width() * one.height());
    };
    // Where a white of its own is another by codes: of a picture four times as bright it is another by less
    // than one, and the engine's one colour mixing a pixel is off by as much.
    constexpr double dark = 0.1;
    for (const char* venue : {"corner", "plain"}) {
      const RenderedFrame even = rendered(venue, needed, Brightness::even, dark);
      for (Brightness way : {Brightness::picture, Brightness::region}) {
        const RenderedFrame solved = rendered(venue, needed, way, dark),
                            inHaste = rendered(venue, outdated, way, dark);
        QVERIFY(inHaste.settled);
        QVERIFY2(2.0 * apart(inHaste, solved) < apart(inHaste, even),
                 qPrintable(QString("%1: %2 from its own, %3 from the even one")
                                .arg(venue)
                                .arg(apart(inHaste, solved))
                                .arg(apart(inHaste, even))));
      }
      Progress silent;
      RendererSettings settings = settingsOf(venue);
      settings.adaptiveRange = true;
      RenderRequest request;
      request.seconds = 1e9;  // all steps
      EngineRenderer ranged(settings, silent);
      settings.brightness = Brightness::region;
      EngineRenderer both(settings, silent);
      QCOMPARE(
          apart(both.render({colours(), 1}, request, needed), ranged.render({colours(), 1}, request, needed)),
          0.0);
    }
  }

  /// Where somebody stands it goes dark within frames, elsewhere it stays; and when he has gone, it is what
  /// it was.
  void aStillIsWhatItWasAfterAShadow() {
    Progress silent;
    RendererSettings settings = settingsOf("corner");
    settings.fillsShadows = true;
    EngineRenderer renderer(settings, silent);
    const Outdated needed = [] { return false; };
    const ContentPicture content{colours(), 1};
    RenderRequest request;
    request.thorough = true;
    const QImage before = renderer.render(content, request, needed).drives[0].image();
    engine::Availability available{{engine::completeGrid({40, 30}, 5)}};
    for (int y = 2; y < 5; ++y)
      for (int x = 3; x < 6; ++x)
        available.projectors[0].share[indexOf(available.projectors[0].cells, {x, y})] = 0.0f;
    RenderRequest shadowed;
    shadowed.available = std::make_shared<const engine::Availability>(available);
    RenderedFrame frame;
    int frames = 0;  // as many as a fade's 0.3 s take
    do {
      frame = renderer.render(content, shadowed, needed);
    } while (!frame.settled && ++frames < 5000);
    QVERIFY(frame.settled);
    const QImage dark = frame.drives[0].image();
    for (int y = 12; y < 23; ++y)
      for (int x = 18; x < 28; ++x) QCOMPARE(dark.pixel(x, y) & 0xffffff, 0u);
    double apart = 0.0;
    for (int y = 0; y < 30; ++y)
      for (int x = 0; x < 8; ++x)
        for (int c = 0; c < 3; ++c)
          apart += std::abs(dark.constScanLine(y)[4 * x + c] - before.constScanLine(y)[4 * x + c]) /
                   (3.0 * 30 * 8);
    // Each other wall of the corner gives some of what is missing; and the engine's one mixing a pixel, and
    // dither.
    QVERIFY2(apart < 5.0, qPrintable(QString::number(apart)));
    // Without, as well as possible at once: solved it is.
    frames = 0;
    do {
      frame = renderer.render(content, RenderRequest(), needed);
    } while (!frame.settled && ++frames < 5000);
    QVERIFY(renderer.render(content, RenderRequest(), needed).drives[0].image() == before);
  }

  void outdatedItIsAFrameInHaste() {
    RenderedFrame solved = rendered("corner", [] { return false; });
    RenderedFrame inHaste = rendered("corner", [] { return true; });
    QVERIFY(!inHaste.drives.empty());
    QVERIFY(inHaste.drives[0].image() != solved.drives[0].image());
    QVERIFY(inHaste.steps < solved.steps);
  }
};

QTEST_GUILESS_MAIN(TestEngineRenderer)
#include "test_engine_renderer.moc"
