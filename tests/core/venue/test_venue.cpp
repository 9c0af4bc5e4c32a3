// SPDX-License-Identifier: MIT
#include <QTemporaryDir>
#include <QTest>
#include <algorithm>
#include <array>
#include <cmath>

#include "relucent/base/error.h"
#include "relucent/base/file.h"
#include "relucent/venue/scenes.h"
#include "relucent/venue/traced_transport.h"
#include "relucent/venue/venue.h"
#include "support/stopped.h"

using namespace relucent;
using namespace relucent::image;
using namespace relucent::rig;
using namespace relucent::transport;
using namespace relucent::venue;

namespace {

VenueSettings smallVenue(const std::string& name) {
  VenueSettings settings;
  settings.name = name;
  settings.projector = {64, 48};
  settings.camera = {40, 30};
  settings.pathsPerPixel = 16;
  return settings;
}

std::vector<Image> flood(const SimulatedVenue& venue) {
  std::vector<Image> pictures;
  for (const auto& projector : venue.rig().projectors) pictures.emplace_back(projector->size(), 3, 1.0f);
  return pictures;
}

std::filesystem::path onlyFile(const std::filesystem::path& folder) {
  std::filesystem::path found;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (!found.empty()) return {};
    found = entry.path();
  }
  return found;
}

void forEachVenue() {
  QTest::addColumn<QString>("name");
  for (const VenueDescription& venue : venues())
    QTest::newRow(venue.name.c_str()) << QString::fromStdString(venue.name);
}

}  // namespace

class TestVenue : public QObject {
  Q_OBJECT
 private slots:
  void looksLikeAPhotograph_data() { forEachVenue(); }
  /// Most of the view is lit, its bright parts reach full scale in 1/60 s, nothing is negative or broken.
  void looksLikeAPhotograph() {
    QFETCH(QString, name);
    Progress progress;
    SimulatedVenue venue(smallVenue(name.toStdString()), {}, progress);
    CameraStack seen = venue.trueRadiance(flood(venue));
    for (float value : seen) QVERIFY(std::isfinite(value) && value >= 0.0f);
    std::vector<float> brightest;
    for (std::size_t i = 0; i < seen.size(); i += 3)
      brightest.push_back(std::max({seen[i], seen[i + 1], seen[i + 2]}));
    std::sort(brightest.begin(), brightest.end());
    QVERIFY(std::abs(brightest[brightest.size() * 99 / 100] / 60.0f - 1.0f) < 0.02f);
    auto lit = brightest.end() - std::upper_bound(brightest.begin(), brightest.end(), 4.0f);
    QVERIFY2(lit > 0.6 * static_cast<double>(brightest.size()), qPrintable(QString::number(lit)));
  }

  void rowsAreCompact_data() { forEachVenue(); }
  void rowsAreCompact() {
    QFETCH(QString, name);
    Progress progress;
    SimulatedVenue venue(smallVenue(name.toStdString()), {}, progress);
    double perRow = static_cast<double>(venue.trueTransport().ownLeaves().blocks()) /
                    static_cast<double>(venue.trueTransport().cameras().count());
    qInfo("%.1f blocks a row", perRow);
    QVERIFY(perRow < 100.0);
  }

  /// camera = T * projector + e
  void transportPredictsRadiance_data() { forEachVenue(); }
  void transportPredictsRadiance() {
    QFETCH(QString, name);
    Progress progress;
    SimulatedVenue venue(smallVenue(name.toStdString()), {}, progress);
    CameraStack predicted = venue.trueTransport().floodlight();
    CameraStack seen = venue.trueRadiance(flood(venue));
    float largest = *std::max_element(seen.begin(), seen.end());
    for (std::size_t i = 0; i < seen.size(); ++i)
      // Both ways of storing T round to 16 bits: some hundred blocks, each within 2e-5 of its row's largest.
      QVERIFY(std::abs(predicted[i] + venue.trueBlack()[i] - seen[i]) < 1e-4f * largest);
  }

  void everyVenueHasTheDevicesThatItSays_data() { forEachVenue(); }
  void everyVenueHasTheDevicesThatItSays() {
    QFETCH(QString, name);
    auto offer = std::find_if(venues().begin(), venues().end(), [&](const VenueDescription& venue) {
      return venue.name == name.toStdString();
    });
    Progress progress;
    SimulatedVenue venue(smallVenue(name.toStdString()), {}, progress);
    QCOMPARE(venue.rig().projectors.size(), static_cast<std::size_t>(offer->projectors));
    QCOMPARE(venue.trueTransport().projectors(),
             Rasters(std::vector<Size>(venue.rig().projectors.size(), Size{64, 48})));
    const Rig rig = venue.rig();
    QCOMPARE(rig.cameras.size(), static_cast<std::size_t>(offer->cameras));
    QCOMPARE(venue.trueTransport().cameras(), Rasters(std::vector<Size>(rig.cameras.size(), Size{40, 30})));
    QCOMPARE(rig.cameraRasters(), venue.trueTransport().cameras());
  }

  /// Law: each camera photographs its own rows of T, with noise of its own under one lamp.
  void eachCameraSeesItsOwnRows() {
    VenueSettings settings = smallVenue("statue3");
    settings.devices.cameraBits = 16;
    settings.devices.flicker = 0.01;
    Progress progress;
    SimulatedVenue venue(settings, {}, progress);
    Rig rig = venue.rig();
    QCOMPARE(rig.cameras[2]->name(), std::string("simulated camera 3"));
    for (std::size_t i = 0; i < rig.projectors.size(); ++i) rig.projectors[i]->show(flood(venue)[i]);
    const CameraStack seen = venue.trueRadiance(flood(venue));
    const Rasters& cameras = venue.trueTransport().cameras();
    const double seconds = 1.0 / 120.0;
    std::vector<Stack> noise;
    std::vector<double> power;
    for (std::size_t camera = 0; camera < cameras.devices(); ++camera) {
      const RawFrame frame = rig.cameras[camera]->capture({{"flood", 1}, 0, seconds});
      double signal = 0.0, expected = 0.0;
      Stack& deviations = noise.emplace_back();
      for (std::size_t i = 0; i < frame.signal.data().size(); ++i) {
        const double light = seconds * static_cast<double>(seen[3 * cameras.offset(camera) + i]);
        const double value = static_cast<double>(frame.signal.data()[i]);
        if (light > 0.8) continue;  // some are full
        signal += value;
        expected += light;
        deviations.push_back(static_cast<float>(value - light));
      }
      power.push_back(signal / expected);
    }
    // A lamp that flickers by 1 % is the same for all to what noise of 3600 values leaves.
    for (double each : power) QVERIFY2(std::abs(each - power[0]) < 1e-3, qPrintable(QString::number(each)));
    QVERIFY(std::abs(power[0] - 1.0) > 1e-4);
    QVERIFY(std::vector(noise[0].begin(), noise[0].begin() + 50) !=
            std::vector(noise[1].begin(), noise[1].begin() + 50));
  }

  /// What several cameras are for: each sees parts of the projectors' light that another does not.
  void threeSidesOfAStatueAreNotOne() {
    Progress progress;
    SimulatedVenue venue(smallVenue("statue3"), {}, progress);
    const TransportMatrix& transport = venue.trueTransport();
    const NodeLayout& layout = transport.layout();
    // Direct light by projector pixel and camera.
    std::vector<std::vector<float>> seen(3, std::vector<float>(transport.projectors().count()));
    for (std::size_t camera = 0; camera < 3; ++camera)
      for (std::size_t pixel = 0; pixel < 1200; ++pixel) {
        const std::size_t row = transport.cameras().offset(camera) + pixel;
        const BlockSparse& leaves = transport.ownLeaves();
        for (std::size_t entry = leaves.rowBegin(row); entry < leaves.rowBegin(row + 1); ++entry) {
          const Node node = layout.node(leaves.column(entry));
          if (node.level == 0) seen[camera][leaves.column(entry)] += leaves.block(row, entry).sum();
        }
      }
    int anywhere = 0, fromOneSideOnly = 0;
    for (std::size_t j = 0; j < transport.projectors().count(); ++j) {
      int places = 0;
      for (const std::vector<float>& camera : seen) places += camera[j] > 1.0f;
      anywhere += places > 0;
      fromOneSideOnly += places == 1;
    }
    qInfo("%d of %zu projector pixels are seen, %d from one side only", anywhere,
          transport.projectors().count(), fromOneSideOnly);
    QVERIFY(anywhere > 0.6 * static_cast<double>(transport.projectors().count()));
    QVERIFY(fromOneSideOnly > 0.03 * anywhere);
  }

  /// Law: whoever stands hidden where a camera stands sees what it sees, in the same units.
  void aHiddenPlaceSeesAsACameraDoes() {
    VenueSettings settings = smallVenue("statue3");
    Scene scene = buildScene(settings);
    scene.hidden = {scene.cameras[0]};
    Progress progress;
    const TracerSettings tracer{.pathsPerPixel = settings.pathsPerPixel};
    const TracedTransport seen = traceTransport(scene, tracer, 60.0, progress);
    const NodeLayout layout(Rasters(std::vector<Size>(2, settings.projector)));
    const ProjectorStack white(3 * layout.projectors().count(), 1.0f);
    const CameraStack flood(seen.cameraByNode.multiplyTransposed(layout.means(white)));
    Scene fromThere = scene;
    fromThere.cameras = scene.hidden;
    const TracedTransport hidden = traceInUnitsOf(scene, flood, fromThere, tracer, progress);
    const Stack there = hidden.cameraByNode.multiplyTransposed(layout.means(white));
    const std::size_t values = 3 * settings.camera.count();
    QCOMPARE(there.size(), values);
    QVERIFY(std::equal(hidden.roomLight.begin(), hidden.roomLight.end(), seen.roomLight.begin()));
    // Units are found from one line of 16-bit codes.
    for (std::size_t i = 0; i < values; ++i) {
      const float camera = flood[i];
      QVERIFY2(std::abs(there[i] - camera) < 1e-3f * (camera + 1.0f),
               qPrintable(QString("%1: %2 %3").arg(i).arg(there[i]).arg(camera)));
    }
  }

  /// No device knows of hidden places; they see the same projectors, room and black level.
  void hiddenPlacesAreOfNoDevice() {
    QTemporaryDir folder;
    Progress progress;
    for (const auto& [name, places] : {std::pair{"statue3", 2}, {"dome4", 1}, {"plain", 0}}) {
      SimulatedVenue venue(smallVenue(name), folder.path().toStdString(), progress);
      const std::size_t cameras = venue.rig().cameras.size();
      const std::optional<SimulatedVenue> hidden = venue.fromHiddenPlaces(progress);
      QCOMPARE(hidden ? hidden->trueTransport().cameras().devices() : 0, static_cast<std::size_t>(places));
      QCOMPARE(venue.rig().cameras.size(), cameras);
      if (!hidden) continue;
      QVERIFY(hidden->trueTransport().projectors() == venue.trueTransport().projectors());
      const auto meanOf = [](const Stack& stack) {
        double sum = 0.0;
        for (float value : stack) sum += static_cast<double>(value);
        return sum / static_cast<double>(stack.size());
      };
      // They stand between the cameras: about as much light comes there, and as much black level.
      const double light = meanOf(hidden->trueTransport().floodlight()) /
                           meanOf(venue.trueTransport().floodlight()),
                   black = meanOf(hidden->trueBlack()) / meanOf(venue.trueBlack());
      qInfo("%s: %.3f of the light, %.3f of the black level", name, light, black);
      QVERIFY(light > 0.5 && light < 1.5 && black > 0.5 && black < 1.5);
      // From the cache they are the same.
      const std::optional<SimulatedVenue> again =
          SimulatedVenue(smallVenue(name), folder.path().toStdString(), progress).fromHiddenPlaces(progress);
      QVERIFY(again->trueTransport().floodlight() == hidden->trueTransport().floodlight());
    }
  }

  /// Four projectors cover the dome, and where they meet they overlap.
  void fourProjectorsShareTheDome() {
    Progress progress;
    SimulatedVenue venue(smallVenue("dome4"), {}, progress);
    const TransportMatrix& transport = venue.trueTransport();
    const BlockSparse& leaves = transport.ownLeaves();
    std::array<int, 5> lit{};  // directly by so many
    std::array<int, 4> by{};
    for (std::size_t row = 0; row < leaves.rows(); ++row) {
      std::array<float, 4> direct{};
      float all = 0.0f;
      for (std::size_t entry = leaves.rowBegin(row); entry < leaves.rowBegin(row + 1); ++entry) {
        const Node node = transport.layout().node(leaves.column(entry));
        if (node.level > 0) continue;
        direct[static_cast<std::size_t>(node.projector)] += leaves.block(row, entry).sum();
        all += leaves.block(row, entry).sum();
      }
      int count = 0;
      for (std::size_t projector = 0; projector < 4; ++projector) {
        const bool isLit = direct[projector] > 0.05f * all && all > 0.0f;
        count += isLit;
        by[projector] += isLit;
      }
      ++lit[static_cast<std::size_t>(count)];
    }
    qInfo("directly lit by none %d, one %d, two %d, three %d, four %d", lit[0], lit[1], lit[2], lit[3],
          lit[4]);
    const double rows = static_cast<double>(leaves.rows());
    QVERIFY(lit[0] < 0.3 * rows);
    QVERIFY(lit[2] + lit[3] + lit[4] > 0.1 * rows && lit[1] > 0.2 * rows);
    for (int each : by) QVERIFY(each > 0.1 * rows);
  }

  /// Superposition: what two projectors give together is what each gives alone, black counted once.
  void theReliefsProjectorsAddUp() {
    Progress progress;
    SimulatedVenue venue(smallVenue("relief"), {}, progress);
    const Image white({64, 48}, 3, 1.0f), black({64, 48}, 3, 0.0f);
    Stack left = venue.trueRadiance({white, black}), right = venue.trueRadiance({black, white});
    Stack dark = venue.trueRadiance({black, black}), both = venue.trueRadiance({white, white});
    float largest = *std::max_element(both.begin(), both.end());
    for (std::size_t i = 0; i < both.size(); ++i)
      // Products of single floats, some hundred to a sum.
      QVERIFY(std::abs(left[i] + right[i] - dark[i] - both[i]) < 1e-5f * largest);
  }

  /// Each projector shines into the other's shadows, and hardly anything is dark for both.
  void theReliefHasTwoSortsOfShadows() {
    Progress progress;
    SimulatedVenue venue(smallVenue("relief"), {}, progress);
    const BlockSparse& leaves = venue.trueTransport().ownLeaves();
    const NodeLayout& layout = venue.trueTransport().layout();
    int lit[4] = {0, 0, 0, 0};  // by neither, the first, the second, both
    for (std::size_t row = 0; row < leaves.rows(); ++row) {
      float direct[2] = {0.0f, 0.0f};
      for (std::size_t entry = leaves.rowBegin(row); entry < leaves.rowBegin(row + 1); ++entry) {
        Node node = layout.node(leaves.column(entry));
        if (node.level == 0) direct[node.projector] += leaves.block(row, entry).sum();
      }
      float least = 0.02f * (direct[0] + direct[1]);
      ++lit[(direct[0] > least ? 1 : 0) + (direct[1] > least ? 2 : 0)];
    }
    qInfo("lit by neither %d, the first %d, the second %d, both %d", lit[0], lit[1], lit[2], lit[3]);
    QVERIFY(lit[0] < 0.03 * 1200 && lit[3] > 0.5 * 1200);
    QVERIFY(lit[1] > 0.03 * 1200 && lit[2] > 0.03 * 1200);
  }

  void blackIsOneOverContrast() {
    VenueSettings settings = smallVenue("plain");
    settings.devices.ambient = 0.0;
    settings.devices.contrast = 500.0;
    Progress progress;
    SimulatedVenue venue(settings, {}, progress);
    CameraStack white = venue.trueTransport().floodlight();
    double black = 0.0, sum = 0.0;
    for (std::size_t i = 0; i < white.size(); ++i) {
      black += static_cast<double>(venue.trueBlack()[i]);
      sum += static_cast<double>(white[i]);
    }
    // Black has a tint: channels from 0.9 to 1.15 of the mean.
    QVERIFY(sum / black > 450.0 && sum / black < 550.0);
  }

  void ambientIsAShareOfTheFloodImage() {
    VenueSettings settings = smallVenue("corner");
    settings.devices.ambient = 0.01;
    settings.devices.contrast = 1e9;
    Progress progress;
    SimulatedVenue venue(settings, {}, progress);
    CameraStack white = venue.trueTransport().floodlight();
    double black = 0.0, sum = 0.0;
    for (std::size_t i = 0; i < white.size(); ++i) {
      black += static_cast<double>(venue.trueBlack()[i]);
      sum += static_cast<double>(white[i]);
    }
    QVERIFY(std::abs(black / sum / 0.01 - 1.0) < 1e-3);
  }

  void devicesOutliveTheVenue() {
    Rig rig;
    {
      Progress progress;
      rig = SimulatedVenue(smallVenue("plain"), {}, progress).rig();
    }
    rig.projectors[0]->show(Image(rig.projectors[0]->size(), 3, 1.0f));
    RawFrame frame = rig.cameras[0]->capture({{"later", 0}, 0, 0.01});
    checkFrame(frame, {40, 30}, "camera");
  }

  /// From the cache, without it, and after the cache was damaged: the same bits.
  void cacheChangesNothing() {
    QTemporaryDir folder;
    std::filesystem::path cache = std::filesystem::path(folder.path().toStdString()) / "venues";
    VenueSettings settings = smallVenue("corner");
    Progress progress;
    SimulatedVenue fresh(settings, {}, progress), traced(settings, cache, progress),
        cached(settings, cache, progress);
    std::filesystem::path file = onlyFile(cache);
    QVERIFY(!file.empty());
    Stack truth = fresh.trueRadiance(flood(fresh));
    QVERIFY(truth == traced.trueRadiance(flood(traced)));
    QVERIFY(truth == cached.trueRadiance(flood(cached)));
    QVERIFY(fresh.trueTransport().ownLeaves() == cached.trueTransport().ownLeaves());
    QVERIFY(fresh.trueBlack() == cached.trueBlack());
  }

  void damagedCacheIsReplaced_data() {
    QTest::addColumn<int>("damage");
    QTest::newRow("empty") << 0;
    QTest::newRow("truncated") << 1;
    QTest::newRow("one bit") << 2;
    QTest::newRow("foreign") << 3;
  }
  void damagedCacheIsReplaced() {
    QFETCH(int, damage);
    QTemporaryDir folder;
    std::filesystem::path cache = folder.path().toStdString();
    VenueSettings settings = smallVenue("plain");
    Progress progress;
    SimulatedVenue first(settings, cache, progress);
    std::filesystem::path file = onlyFile(cache);
    std::string good = readFile(file), bad = good;
    if (damage == 0) bad.clear();
    if (damage == 1) bad.resize(good.size() / 2);
    if (damage == 2) bad[good.size() / 2] = static_cast<char>(bad[good.size() / 2] ^ 4);
    if (damage == 3) bad = "PNG";
    writeFileAtomically(file, bad);
    SimulatedVenue second(settings, cache, progress);
    QVERIFY(readFile(file) == good);
    QVERIFY(first.trueRadiance(flood(first)) == second.trueRadiance(flood(second)));
  }

  void otherSettingsAreTracedAnew() {
    QTemporaryDir folder;
    std::filesystem::path cache = folder.path().toStdString();
    VenueSettings settings = smallVenue("plain");
    Progress progress;
    SimulatedVenue first(settings, cache, progress);
    settings.seed = 77;  // of the noise: the scene stays
    SimulatedVenue sameScene(settings, cache, progress);
    QVERIFY(!onlyFile(cache).empty());
    settings.devices.vignetting = 0.0;
    SimulatedVenue other(settings, cache, progress);
    QVERIFY(onlyFile(cache).empty());
    QVERIFY(first.trueRadiance(flood(first)) == sameScene.trueRadiance(flood(sameScene)));
    QVERIFY(!(first.trueRadiance(flood(first)) == other.trueRadiance(flood(other))));
  }

  void unusableSettings_data() {
    QTest::addColumn<QString>("name");
    QTest::addColumn<int>("width");
    QTest::addColumn<int>("paths");
    QTest::addColumn<QString>("says");
    QTest::newRow("unknown") << "cellar" << 64 << 16
                             << "there is no simulated venue \"cellar\"; there are corner";
    QTest::newRow("no name") << "" << 64 << 16 << "there is no simulated venue";
    QTest::newRow("no size") << "plain" << 0 << 16 << "projector of 0x48 pixels is not possible";
    QTest::newRow("negative") << "plain" << -64 << 16 << "is not possible";
    QTest::newRow("huge") << "plain" << 100000 << 16 << "is not possible";
    QTest::newRow("no paths") << "plain" << 64 << 0 << "paths per pixel";
  }
  void unusableSettings() {
    QFETCH(QString, name);
    QFETCH(int, width);
    QFETCH(int, paths);
    QFETCH(QString, says);
    VenueSettings settings = smallVenue(name.toStdString());
    settings.projector.width = width;
    settings.pathsPerPixel = paths;
    Progress progress;
    try {
      SimulatedVenue venue(settings, {}, progress);
      QFAIL("no error");
    } catch (const Error& error) {
      QVERIFY(error.kind() == ErrorKind::input);
      QVERIFY2(QString(error.what()).contains(says), error.what());
    }
  }

  void unwritableCacheIsAnError() {
    QTemporaryDir folder;
    std::filesystem::path file = std::filesystem::path(folder.path().toStdString()) / "file";
    writeFileAtomically(file, "in the way");
    Progress progress;
    QVERIFY_THROWS_EXCEPTION(Error, SimulatedVenue(smallVenue("plain"), file, progress));
    QVERIFY(readFile(file) == "in the way");
  }

  void tracingCanBeCancelled() {
    Stopped stopped;
    QVERIFY_THROWS_EXCEPTION(Cancelled, SimulatedVenue(smallVenue("corner"), {}, stopped));
  }
};

QTEST_APPLESS_MAIN(TestVenue)
#include "test_venue.moc"
