// SPDX-License-Identifier: MIT
// Pictures that stay on the graphics card from the engine to the projectors' windows. Runs on two screens,
// see tests/support/with-two-screens, there by a software renderer.
#include <QOpenGLFunctions>
#include <QPainter>
#include <QTemporaryDir>
#include <QtTest>
#include <filesystem>
#include <set>

#include "gui/output/scripted_renderer.h"
#include "gui/output/two_screens.h"
#include "output/engine_renderer.h"
#include "output/opengl_surface.h"
#include "output/overlay.h"
#include "output/projector_window.h"
#include "output/shared_gl.h"
#include "relucent/pipeline/calibrate.h"

using namespace relucent;
using namespace relucent::engine;
using namespace relucent::gui;
using namespace relucent::pipeline;
namespace fs = std::filesystem;

namespace {

constexpr QSize contentSize(64, 48);

QImage contentOf(int number) {
  QImage image(contentSize, QImage::Format_RGBX8888);
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x)
      image.setPixelColor(
          x, y, QColor::fromHsv((23 * (x / 8 + number)) % 360, 40 * (y / 8), 60 + 24 * ((x + y) / 16)));
  return image;
}

/// A picture on the graphics card.
DrivePicture onCard(const QImage& picture) {
  auto card = std::make_shared<CardPicture>(picture.size());
  const QImage pixels = picture.convertToFormat(QImage::Format_RGBA8888);
  SharedGl::existing()->run([&](QOpenGLContext& context) {
    QOpenGLFunctions& gl = *context.functions();
    gl.glBindTexture(GL_TEXTURE_2D, card->texture());
    gl.glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, pixels.width(), pixels.height(), GL_RGBA, GL_UNSIGNED_BYTE,
                       pixels.constBits());
    gl.glFinish();
  });
  return DrivePicture(card);
}

bool isSharing(const ProjectorWindow& window) {
  return dynamic_cast<const OpenGlSurface&>(window.surface()).isSharing();
}

std::unique_ptr<GlHost> sharedHost() {
  return SharedGl::instance()->host();
}

}  // namespace

class TestCardPictures : public QObject {
  Q_OBJECT

  QTemporaryDir temporary_;
  fs::path root() const { return temporary_.path().toStdString(); }

  std::unique_ptr<EngineRenderer> rendererOf(const QString& venue, const MakeGlHost& host) {
    Progress silent;
    RendererSettings settings{root() / venue.toStdString(), {contentSize, compensation::Fit::fit}};
    settings.backend = BackendChoice::openGl;
    return std::make_unique<EngineRenderer>(settings, silent, FallbackBackend::Notify(), host);
  }

 private slots:
  void initTestCase() {
    if (!hasOpenGl()) QSKIP("there is no OpenGL");
    Progress silent;
    for (const char* name : {"corner", "relief"}) {
      venue::VenueSettings venue;
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

  /// Law: a window shows what is on the card, and what lies over it, pixel for pixel; also one whose context
  /// was there before any was shared.
  void aWindowShowsWhatIsOnTheCard() {
    QVERIFY(SharedGl::existing() == nullptr);
    ProjectorWindow older(projector);
    older.shine();
    QTRY_VERIFY(older.isExposed());
    older.present(noise(projectorSize, 1));
    QTRY_VERIFY(seenOn("DUMMY1") == noise(projectorSize, 1));
    QVERIFY(SharedGl::instance() != nullptr);
    older.present(onCard(noise(projectorSize, 2)));
    QTRY_VERIFY(seenOn("DUMMY1") == noise(projectorSize, 2));
    QVERIFY(!isSharing(older));
    older.stop();

    ProjectorWindow window(projector);
    window.shine();
    QTRY_VERIFY(window.isExposed());
    for (quint32 seed : {3u, 4u}) {
      window.present(onCard(noise(projectorSize, seed)));
      QTRY_VERIFY(seenOn("DUMMY1") == noise(projectorSize, seed));
      window.present(noise(projectorSize, 10 + seed));
      QTRY_VERIFY(seenOn("DUMMY1") == noise(projectorSize, 10 + seed));
    }
    QVERIFY(isSharing(window));
    const QImage overlay = overlayPicture(projectorSize, {"steps"});
    for (const DrivePicture& picture :
         {onCard(noise(projectorSize, 5)), DrivePicture(noise(projectorSize, 5))}) {
      window.present(picture, overlay);
      QImage expected = noise(projectorSize, 5);
      QPainter(&expected).drawImage(0, 0, overlay);
      QTRY_VERIFY(seenOn("DUMMY1") == expected);
    }
    window.blacken();
    QTRY_VERIFY(allBlack(seenOn("DUMMY1")));
  }

  void whatIsReadBackIsWhatWasWritten() {
    const QImage picture = noise({61, 37}, 1);
    QCOMPARE(onCard(picture).image().convertToFormat(QImage::Format_RGB32), picture);
    QVERIFY(onCard(picture).key() != onCard(picture).key());
    QVERIFY(DrivePicture().isNull() && !onCard(picture).isNull());
  }

  /// Law: a picture that somebody shows is never drawn over, and no more are made than are shown and four.
  void picturesAreUsedAgainWhenNobodyShowsThem() {
    CardPictures pictures({{8, 6}, {4, 4}});
    std::vector<std::vector<std::shared_ptr<CardPicture>>> shown;
    std::set<unsigned> textures;
    QRandomGenerator random(1);
    for (int frame = 0; frame < 200; ++frame) {
      const auto next = pictures.next();
      QCOMPARE(next.size(), std::size_t{2});
      QCOMPARE(next[1]->size(), QSize(4, 4));
      for (const auto& held : shown) QVERIFY(held[0] != next[0] && held[1] != next[1]);
      textures.insert(next[0]->texture());
      shown.push_back(next);
      while (shown.size() > 3) shown.erase(shown.begin() + random.bounded(static_cast<int>(shown.size())));
    }
    QVERIFY2(textures.size() <= 3 + 4, qPrintable(QString::number(textures.size())));
  }

  /// Law: what stays on the card is bit for bit what goes through memory.
  void whatStaysOnTheCardIsTheSame_data() {
    QTest::addColumn<QString>("venue");
    QTest::addColumn<bool>("compensated");
    for (const char* venue : {"corner", "relief"})
      for (bool compensated : {false, true})
        QTest::addRow("%s%s", venue, compensated ? ", compensated" : "") << venue << compensated;
  }
  void whatStaysOnTheCardIsTheSame() {
    QFETCH(QString, venue);
    QFETCH(bool, compensated);
    const auto inMemory = rendererOf(venue, {}), onTheCard = rendererOf(venue, sharedHost);
    const std::size_t projectors = inMemory->projectors().size();
    QCOMPARE(projectors, std::size_t{venue == "relief" ? 2u : 1u});
    RenderRequest request;
    request.compensated = compensated;
    request.seconds = 100.0;  // for all steps
    std::vector<RenderedFrame> kept;
    for (int number = 0; number < 6; ++number) {
      const ContentPicture content{contentOf(number), static_cast<std::uint64_t>(number + 1)};
      const Outdated never = [] { return false; };
      const RenderedFrame expected = inMemory->render(content, request, never);
      kept.push_back(onTheCard->render(content, request, never));
      const RenderedFrame& frame = kept.back();
      QCOMPARE(frame.drives.size(), projectors);
      QCOMPARE(frame.steps, expected.steps);
      QCOMPARE(frame.clipped, expected.clipped);
      for (std::size_t i = 0; i < projectors; ++i) {
        QVERIFY(frame.drives[i].card() != nullptr && expected.drives[i].card() == nullptr);
        QCOMPARE(frame.drives[i].image(), expected.drives[i].image());
      }
    }
    // Those that were rendered before are still what they were.
    for (std::size_t i = 0; i + 1 < kept.size(); ++i)
      QVERIFY(kept[i].drives[0].image() != kept[i + 1].drives[0].image());
  }

  /// The engine renders on any thread, and may end before its pictures do.
  void itIsShownWhileOtherThreadsGoOn() {
    auto renderer = rendererOf("corner", sharedHost);
    const QSize size = renderer->projectors().front();
    DrivePicture last;
    {
      ProjectorWindow window(projector);
      window.shine();
      QTRY_VERIFY(window.isExposed());
      RenderRequest request;
      request.seconds = 100.0;
      for (int number = 0; number < 20; ++number) {
        std::unique_ptr<QThread> worker(QThread::create([&] {
          last = renderer
                     ->render({contentOf(number), static_cast<std::uint64_t>(number + 1)}, request,
                              [] { return false; })
                     .drives.front();
        }));
        worker->start();
        QVERIFY(worker->wait(60000));
        window.present(last);
        const QPoint corner((projectorSize.width() - size.width()) / 2,
                            (projectorSize.height() - size.height()) / 2);
        const QImage expected = last.image().convertToFormat(QImage::Format_RGB32);
        QTRY_VERIFY(seenOn("DUMMY1").copy(QRect(corner, size)) == expected);
      }
      renderer.reset();
      window.update();
      QVERIFY(!last.image().isNull());
    }
    QVERIFY(!last.image().isNull());
  }
};

QTEST_MAIN(TestCardPictures)
#include "test_card_pictures.moc"
