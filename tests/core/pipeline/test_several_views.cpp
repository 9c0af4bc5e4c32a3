// SPDX-License-Identifier: MIT
// Venues that several cameras look at, from the map between their views to what each of them sees.
#include "relucent/compensation/views.h"

#include <QTemporaryDir>
#include <QTest>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>

#include "relucent/base/random.h"
#include "relucent/compensation/methods.h"
#include "relucent/image/metrics.h"
#include "relucent/image/picture_files.h"
#include "relucent/pipeline/calibrate.h"
#include "relucent/pipeline/compensate.h"
#include "relucent/pipeline/devices.h"
#include "relucent/pipeline/evaluate.h"
#include "relucent/pipeline/measured_venue.h"
#include "relucent/pipeline/projection.h"
#include "relucent/pipeline/proof_record.h"
#include "relucent/pipeline/prove.h"
#include "relucent/pipeline/standard_images.h"
#include "relucent/venue/scenes.h"
#include "relucent/venue/traced_transport.h"
#include "support/sanitized.h"
#include "support/sentences.h"

using namespace relucent;
using namespace relucent::calibration;
using namespace relucent::compensation;
using namespace relucent::image;
using namespace relucent::pipeline;
using namespace relucent::transport;
using namespace relucent::venue;
using Eigen::Vector2f;
using Eigen::Vector3f;
namespace fs = std::filesystem;

namespace {

/// Where a camera sees a point.
Vector2f seenAt(const CameraOptics& camera, const Vector3f& point) {
  const Vector3f path = point - camera.pose.position;
  const float depth = path.dot(camera.pose.forward), width = static_cast<float>(camera.raster.width);
  return {0.5f * width + path.dot(camera.pose.right) / depth * camera.throwRatio * width,
          0.5f * static_cast<float>(camera.raster.height) -
              path.dot(camera.pose.up) / depth * camera.throwRatio * width};
}

/// Rows of T, one matrix below the other.
TransportMatrix stacked(const TransportMatrix& above, const TransportMatrix& below) {
  std::vector<Size> sizes = above.cameras().sizes();
  sizes.insert(sizes.end(), below.cameras().sizes().begin(), below.cameras().sizes().end());
  std::vector<float> fullScale;
  const TransportMatrix parts[] = {above.flattened(), below.flattened()};
  for (const TransportMatrix& part : parts) {
    const BlockSparse& leaves = part.ownLeaves();
    for (std::size_t row = 0; row < leaves.rows(); ++row) {
      float& largest = fullScale.emplace_back(0.0f);
      for (std::size_t entry = leaves.rowBegin(row); entry < leaves.rowBegin(row + 1); ++entry)
        largest = std::max(largest, leaves.sizeOf(row, entry).largest);
    }
  }
  BlockSparseBuilder builder(above.layout().count(), fullScale);
  std::size_t first = 0;
  for (const TransportMatrix& part : parts) {
    const BlockSparse& leaves = part.ownLeaves();
    for (std::size_t row = 0; row < leaves.rows(); ++row)
      for (std::size_t entry = leaves.rowBegin(row); entry < leaves.rowBegin(row + 1); ++entry)
        builder.add(first + row, leaves.column(entry), leaves.block(row, entry));
    first += leaves.rows();
  }
  return {Rasters(sizes), above.projectors(), builder.build()};
}

/// A venue measured by its cameras, and without noise by one that stands at each hidden place.
MeasuredVenue withCamerasAt(const MeasuredVenue& measured, const SimulatedVenue& places) {
  MeasuredVenue venue;
  venue.transport = stacked(measured.transport, places.trueTransport());
  const auto joined = [](auto values, const auto& more) {
    values.insert(values.end(), more.begin(), more.end());
    return values;
  };
  const CameraStack flood = places.trueTransport().floodlight();
  Acquisition exact;
  exact.flood = flood;
  exact.floodVariance.assign(flood.size(), 0.0f);
  exact.flagged.assign(flood.size() / 3, 0);
  venue.black = joined(measured.black, places.trueBlack());
  venue.flood = joined(measured.flood, flood);
  venue.usable = joined(measured.usable, usablePixels(exact));
  Progress quiet;
  venue.direct = directlyLit(directLooks(venue.transport, {}, quiet));
  venue.views = viewMap(venue.transport, seesProjection(venue));
  return venue;
}

double psnrOf(const std::vector<MethodScore>& scores) {
  return scores.front().psnrReachable;
}

/// Of a venue, what its first camera measured alone.
MeasuredVenue firstAlone(const MeasuredVenue& all) {
  const Size size = all.transport.cameras().size(0);
  const TransportMatrix flat = all.transport.flattened();
  const BlockSparse& leaves = flat.ownLeaves();
  std::vector<float> fullScale(size.count());
  for (std::size_t row = 0; row < size.count(); ++row)
    for (std::size_t entry = leaves.rowBegin(row); entry < leaves.rowBegin(row + 1); ++entry)
      fullScale[row] = std::max(fullScale[row], leaves.sizeOf(row, entry).largest);
  BlockSparseBuilder builder(leaves.columns(), fullScale);
  for (std::size_t row = 0; row < size.count(); ++row)
    for (std::size_t entry = leaves.rowBegin(row); entry < leaves.rowBegin(row + 1); ++entry)
      builder.add(row, leaves.column(entry), leaves.block(row, entry));
  const auto first = [&](const auto& values, std::size_t each) {
    auto part = values;
    part.resize(each * size.count());
    return part;
  };
  MeasuredVenue venue;
  venue.transport = TransportMatrix(Rasters(size), all.transport.projectors(), builder.build());
  venue.black = first(all.black, 3);
  venue.flood = first(all.flood, 3);
  venue.usable = first(all.usable, 1);
  venue.direct = first(all.direct, 1);
  return venue;
}

}  // namespace

class TestSeveralViews : public QObject {
  Q_OBJECT

  QTemporaryDir temporary_;
  fs::path root() const { return temporary_.path().toStdString(); }
  fs::path cache() const { return root() / "cache"; }

  /// The calibration of a venue, made when it is first asked for.
  fs::path calibrated(const std::string& name, Size projector, Size camera) const {
    const fs::path path = root() / (name + std::to_string(projector.width));
    if (fs::exists(path)) return path;
    VenueSettings venue;
    venue.name = name;
    venue.projector = projector;
    venue.camera = camera;
    venue.pathsPerPixel = 64;
    CalibrateSettings settings;
    settings.rig = venue;
    Progress silent;
    calibrate(path, settings, cache(), silent);
    return path;
  }
  static MeasuredCalibration loaded(const fs::path& path) {
    Progress silent;
    return loadCalibration(CalibrationFolder::open(path, CalibrationFolder::Access::read), silent);
  }
  fs::path statue() const {
    return isSanitized ? calibrated("statue3", {48, 36}, {32, 24})
                       : calibrated("statue3", {96, 72}, {64, 48});
  }
  fs::path dome() const { return calibrated("dome4", {64, 48}, {64, 48}); }

  std::optional<EvaluateResult> statueEvaluated_, domeEvaluated_;
  /// What *refined* makes of three pictures, judged once for all that look at it.
  const EvaluateResult& evaluated(std::optional<EvaluateResult>& once, const fs::path& path, bool blended) {
    if (once) return *once;
    EvaluateSettings evaluating;
    evaluating.fewImages = true;
    evaluating.methods = {Method::refined};
    evaluating.blended = blended;
    Progress silent;
    return once.emplace(evaluate(path, evaluating, cache(), silent));
  }
  const EvaluateResult& statueEvaluated() { return evaluated(statueEvaluated_, statue(), false); }
  /// With what it would be if each projector were solved alone.
  const EvaluateResult& domeEvaluated() { return evaluated(domeEvaluated_, dome(), true); }

 private slots:
  /// Law: on a flat wall the map between two views is their homography, to less than half a pixel.
  void aFlatWallIsAHomography_data() {
    QTest::addColumn<float>("x");
    QTest::addColumn<float>("y");
    QTest::addColumn<float>("throwRatio");
    QTest::newRow("the same place") << -0.40f << 0.12f << 1.68f;
    QTest::newRow("from the side") << 1.2f << 0.3f << 1.6f;
    QTest::newRow("from below, finer") << 0.1f << -0.8f << 2.4f;
  }
  void aFlatWallIsAHomography() {
    QFETCH(float, x);
    QFETCH(float, y);
    QFETCH(float, throwRatio);
    VenueSettings settings;
    settings.name = "plain";
    settings.projector = {64, 48};
    settings.camera = {56, 42};
    Scene scene = buildScene(settings);
    CameraOptics second = scene.cameras.front();
    second.pose = Pose::lookingAt({x, y, 2.4f}, {0.0f, 0.0f, 0.0f});
    second.throwRatio = throwRatio;
    scene.cameras.push_back(second);
    Progress silent;
    const TracedTransport traced = traceTransport(scene, {.pathsPerPixel = 64}, 60.0, silent);
    const TransportMatrix transport(Rasters(std::vector<Size>(2, settings.camera)),
                                    Rasters(settings.projector), traced.cameraByNode.transposed());
    const CameraStack flood = transport.floodlight();
    CameraMask lit(transport.cameras().count());
    for (std::size_t i = 0; i < lit.size(); ++i) lit[i] = flood[3 * i + 1] > 5.0f;
    const ViewMap map = viewMap(transport, lit);
    std::vector<double> apart;
    for (std::size_t i = 0; i < settings.camera.count(); ++i) {
      const Pixel at = pixelAt(settings.camera, i);
      const auto& first = map[i];
      QVERIFY(first[0] == static_cast<float>(at.x) + 0.5f && first[1] == static_cast<float>(at.y) + 0.5f);
      const auto& place = map[settings.camera.count() + i];
      QCOMPARE(std::isfinite(place[0]), lit[settings.camera.count() + i] != 0);
      if (!std::isfinite(place[0])) continue;
      const Ray ray = second.ray(Vector2f(static_cast<float>(at.x) + 0.5f, static_cast<float>(at.y) + 0.5f));
      const Vector3f point = ray.origin - ray.origin.z() / ray.direction.z() * ray.direction;
      const Vector2f expected = seenAt(scene.cameras.front(), point);
      // Beyond what the first camera sees lit the map is a guess.
      if (expected.x() < 2 || expected.y() < 2 || expected.x() > 54 || expected.y() > 40) continue;
      if (!lit[indexOf(settings.camera, {static_cast<int>(expected.x()), static_cast<int>(expected.y())})])
        continue;
      apart.push_back(std::hypot(place[0] - expected.x(), place[1] - expected.y()));
    }
    QVERIFY2(apart.size() > 500, qPrintable(QString::number(apart.size())));
    std::sort(apart.begin(), apart.end());
    qInfo("%zu places, median %.2f, 95 %% within %.2f, all within %.2f pixels", apart.size(),
          apart[apart.size() / 2], apart[apart.size() * 95 / 100], apart.back());
    QVERIFY(apart[apart.size() * 95 / 100] < 0.5);
  }

  /// Law: shares sum to one, lie beside the place, and are of pixels that are inside.
  void samplesAreOfPixelsInside() {
    const Size view{9, 7};
    Random random{3};
    CameraMask inside(view.count());
    for (auto& flag : inside) flag = random.below(3) > 0;
    for (int i = 0; i < 2000; ++i) {
      const std::array<float, 2> place{12.0f * random.uniformFloat() - 1.5f,
                                       10.0f * random.uniformFloat() - 1.5f};
      const auto sample = sampleAt(place, view, inside);
      const Pixel own{static_cast<int>(std::floor(place[0])), static_cast<int>(std::floor(place[1]))};
      const bool isWithin = own.x >= 0 && own.y >= 0 && own.x < view.width && own.y < view.height;
      QCOMPARE(sample.has_value(), isWithin && inside[indexOf(view, own)] != 0);
      if (!sample) continue;
      float sum = 0.0f;
      for (std::size_t k = 0; k < 4; ++k) {
        if (!(sample->share[k] > 0.0f)) continue;
        const Pixel at = pixelAt(view, sample->pixel[k]);
        QVERIFY(inside[sample->pixel[k]]);
        QVERIFY(std::abs(static_cast<float>(at.x) + 0.5f - place[0]) <= 1.0f &&
                std::abs(static_cast<float>(at.y) + 0.5f - place[1]) <= 1.0f);
        sum += sample->share[k];
      }
      QVERIFY(std::abs(sum - 1.0f) < 1e-5f);
    }
    QVERIFY(!sampleAt({std::nanf(""), 1.0f}, view, inside));
  }

  /// One camera knows of no other view: nothing changes.
  void oneCameraHasNoMap() {
    VenueSettings settings;
    settings.projector = {32, 24};
    settings.camera = {24, 18};
    settings.pathsPerPixel = 16;
    Progress silent;
    const SimulatedVenue venue(settings, {}, silent);
    QVERIFY(viewMap(venue.trueTransport(), CameraMask(24 * 18, 1)).empty());
  }

  /// What several cameras are for: the picture is right from each of three sides, where a calibration from
  /// one side is wrong from the others.
  void threeViewsAreBetterThanOne() {
    if (isSanitized) QSKIP("qualities are compared without sanitizers; others run this code there");
    Progress silent;
    const EvaluateResult& joint = statueEvaluated();

    const MeasuredCalibration measured = loaded(statue());
    const MeasuredVenue alone = firstAlone(measured.venue);
    const compensation::RidgeChoice inverse = invert(alone, {}, silent);
    const Compensator compensator(alone, inverse.inverse);
    const OpenedRig rig = openRig(measured.rig, cache(), silent);
    const Rasters& cameras = measured.venue.transport.cameras();
    std::vector<double> together(3, 0.0), single(3, 0.0);
    const std::vector<NamedImage> images = standardImages();
    for (std::size_t image = 0; image < images.size(); ++image) {
      const Target wanted = fitTarget(images[image].linear, measured.venue, {});
      TargetSettings sameCorners;
      sameCorners.corners = wanted.corners;
      const Target own = fitTarget(images[image].linear, alone, sameCorners);
      const Compensation solved = compensator.solve(Method::refined, own, silent);
      const CameraStack seen = rig.venue->trueRadiance(
          encodedDrive(solved.projector, measured.venue.transport.projectors(), measured.linearization));
      // As bright as it aims to be.
      CameraStack bright = wanted.wanted;
      for (std::size_t i = 0; i < bright.size(); ++i)
        if (wanted.inside[i / 3]) bright[i] *= own.white[0] / wanted.white[0];
      for (std::size_t camera = 0; camera < 3; ++camera) {
        const auto begin = wanted.reachable.begin() + static_cast<std::ptrdiff_t>(cameras.offset(camera));
        const CameraMask mask(begin, begin + static_cast<std::ptrdiff_t>(cameras.size(camera).count()));
        single[camera] += psnr(imageFromStack(seen, cameras, camera), imageFromStack(bright, cameras, camera),
                               own.white, mask) /
                          static_cast<double>(images.size());
        const std::vector<MethodScore>& scores =
            camera == 0 ? joint.images[image].methods : joint.images[image].others.at(camera - 1).methods;
        together[camera] += scores.front().psnrReachable / static_cast<double>(images.size());
      }
    }
    for (std::size_t camera = 0; camera < 3; ++camera)
      qInfo("camera %zu: %.2f dB from all views, %.2f dB from the first alone", camera + 1, together[camera],
            single[camera]);
    QVERIFY(std::ranges::min(together) > std::ranges::min(single) + 4.0);
    QVERIFY(joint.images[0].others[0].reachable > 0.7);
  }

  /// A camera that looks where no other does is told of as soon as all is measured.
  void aCameraThatLooksElsewhereIsAFinding() {
    const CalibrationFolder folder = CalibrationFolder::open(statue(), CalibrationFolder::Access::read);
    MeasuredCalibration measured = loaded(statue());
    const std::size_t before = summaryOf(folder, measured).findings.size();
    const Rasters& cameras = measured.venue.transport.cameras();
    for (std::size_t i = cameras.offset(2); i < cameras.count(); ++i)
      measured.venue.views[i] = {std::nanf(""), std::nanf("")};
    const std::vector<Message> findings = summaryOf(folder, measured).findings;
    QCOMPARE(findings.size(), before + 1);
    QVERIFY(english(findings.back()).starts_with("camera 3 sees no lit place that another camera sees"));
  }

  void placesBetweenCameras_data() {
    QTest::addColumn<QString>("venue");
    QTest::newRow("statue3") << "statue3";
    QTest::newRow("dome4") << "dome4";
  }
  /// Whoever stands between the cameras, of whom nothing was measured, sees the picture within 3 dB of what
  /// he would see if a camera had stood there.
  void placesBetweenCameras() {
    if (isSanitized) QSKIP("qualities are compared without sanitizers; others run this code there");
    QFETCH(QString, venue);
    // Where cameras are coarser than projectors, what lies between their pixels is nobody's wish.
    const bool isDome = venue == "dome4";
    const fs::path path = isDome ? dome() : calibrated(venue.toStdString(), {64, 48}, {64, 48});
    Progress silent;
    std::optional<EvaluateResult> own;
    const EvaluateResult& result = isDome ? domeEvaluated() : evaluated(own, path, false);

    const MeasuredCalibration measured = loaded(path);
    const OpenedRig rig = openRig(measured.rig, cache(), silent);
    const std::optional<SimulatedVenue> hidden = rig.venue->fromHiddenPlaces(silent);
    const MeasuredVenue more = withCamerasAt(measured.venue, *hidden);
    const compensation::RidgeChoice inverse = invert(more, {}, silent);
    const Compensator compensator(more, inverse.inverse);
    const Rasters& cameras = more.transport.cameras();
    const std::size_t known = measured.venue.transport.cameras().devices(),
                      places = cameras.devices() - known;
    std::vector<double> unseen(places, 0.0), withCamera(places, 0.0);
    const std::vector<NamedImage> images = standardImages();
    for (std::size_t image = 0; image < images.size(); ++image) {
      TargetSettings same;
      same.corners = fitTarget(images[image].linear, measured.venue, {}).corners;
      const Target target = fitTarget(images[image].linear, more, same);
      const std::vector<Image> drive =
          encodedDrive(compensator.solve(Method::refined, target, silent).projector,
                       more.transport.projectors(), measured.linearization);
      const CameraStack seen = hidden->trueRadiance(drive);
      const Rasters& there = hidden->trueTransport().cameras();
      const auto parts = static_cast<double>(images.size());
      QCOMPARE(result.images[image].unseen.size(), places);
      for (std::size_t place = 0; place < places; ++place) {
        const auto begin =
            target.reachable.begin() + static_cast<std::ptrdiff_t>(cameras.offset(known + place));
        const CameraMask mask(begin, begin + static_cast<std::ptrdiff_t>(there.size(place).count()));
        withCamera[place] += psnr(imageFromStack(seen, there, place),
                                  imageFromStack(target.wanted, cameras, known + place), target.white, mask) /
                             parts;
        unseen[place] += psnrOf(result.images[image].unseen[place].methods) / parts;
        QVERIFY(result.images[image].unseen[place].reachable > 0.7);
      }
    }
    for (std::size_t place = 0; place < places; ++place) {
      qInfo("%s, place %zu: %.2f dB unseen, %.2f dB had a camera stood there", qPrintable(venue), place + 1,
            unseen[place], withCamera[place]);
      QVERIFY(unseen[place] > withCamera[place] - 3.0);
    }
  }

  /// Whoever walks past the cameras has at each of them no less than if the picture were for all alike,
  /// though the show has two steps a frame only. What is seen on the way is written.
  void aViewerWalksPastTheCameras() {
    if (isSanitized) QSKIP("qualities are compared without sanitizers; others run this code there");
    Progress silent;
    EvaluateSettings evaluating;
    evaluating.fewImages = true;
    evaluating.methods = {Method::refined};
    // Round the statue at 0, -45 and 45 degrees: the first camera is passed halfway.
    const std::vector<Position> places{{0, 2.4, 0}, {-1.77, 1.67, 0}, {1.77, 1.67, 0}};
    const std::vector<std::size_t> passed{12, 0, 24};
    for (const Position& place : places) evaluating.target.views.push_back({1.0, {}, {}, place});
    evaluating.walk = {25, 2, root() / "film"};
    const EvaluateResult result = evaluate(statue(), evaluating, cache(), silent);
    QCOMPARE(result.walk.size(), std::size_t{25});
    for (std::size_t camera = 0; camera < 3; ++camera) {
      const WalkFrame& there = result.walk[passed[camera]];
      QVERIFY(there.viewer == places[camera] && there.weights[camera] > 0.999);
      const ImageScore& alike = result.images[0];
      const double all = psnrOf(camera == 0 ? alike.methods : alike.others[camera - 1].methods);
      qInfo("camera %zu: %.2f dB for him as he passes, %.2f dB for all alike", camera + 1, there.psnr[camera],
            all);
      QVERIFY(there.psnr[camera] > all - 0.5);
      QCOMPARE(there.unseen.size(), std::size_t{2});
    }
    for (int frame : {1, 25}) {
      const Picture seen = readPicture(root() / "film" / fmt::format("frame-{:04}.png", frame));
      QCOMPARE(seen.encoded.width(), 5 * 64);
    }
    QVERIFY(!fs::exists(root() / "film" / "frame-0026.png"));
  }

  void walksThatCannotBe_data() {
    QTest::addColumn<int>("frames");
    QTest::addColumn<int>("positions");
    QTest::addColumn<QString>("part");
    QTest::newRow("one frame") << 1 << 3 << "two frames or more";
    QTest::newRow("backwards") << -5 << 3 << "two frames or more";
    QTest::newRow("a film of nothing") << 0 << 3 << "needs the number of its frames";
    QTest::newRow("places unknown") << 5 << 2 << "where all of them stand";
  }
  void walksThatCannotBe() {
    if (isSanitized) QSKIP("qualities are compared without sanitizers; others run this code there");
    QFETCH(int, frames);
    QFETCH(int, positions);
    QFETCH(QString, part);
    EvaluateSettings evaluating;
    evaluating.fewImages = true;
    evaluating.methods = {Method::mix};
    for (int camera = 0; camera < 3; ++camera)
      evaluating.target.views.push_back(
          {1.0, {}, {}, camera < positions ? std::optional(Position{1.0 * camera, 0, 0}) : std::nullopt});
    evaluating.walk = {frames, 2, root() / "no film"};
    const std::string sentence = sentenceOf(
        [&] {
          Progress silent;
          evaluate(statue(), evaluating, cache(), silent);
        },
        ErrorKind::input);
    QVERIFY(mentions(sentence, part.toStdString()));
  }

  /// Pictures of their own are upright from each place, at a price that is told; between them nothing is
  /// wanted.
  void eachSideHasAPictureOfItsOwn() {
    if (isSanitized) QSKIP("qualities are compared without sanitizers; others run this code there");
    Progress silent;
    EvaluateSettings evaluating;
    evaluating.fewImages = true;
    evaluating.methods = {Method::refined};
    const EvaluateResult& surface = statueEvaluated();
    evaluating.target.views = {{}, {1.0, ViewPlacement::own, {}}, {1.0, ViewPlacement::own, {}}};
    const EvaluateResult own = evaluate(statue(), evaluating, cache(), silent);
    for (const EvaluateResult* result : {&own, &surface})
      for (const ImageScore& image : result->images)
        qInfo("%s, %s: %.2f, %.2f, %.2f dB, %.0f %% visibly worse", result == &own ? "own" : "surface",
              image.name.c_str(), psnrOf(image.methods), psnrOf(image.others[0].methods),
              psnrOf(image.others[1].methods), 100.0 * image.contradiction->share);
    for (std::size_t image = 0; image < own.images.size(); ++image) {
      QVERIFY(own.images[image].unseen.empty() && !surface.images[image].unseen.empty());
      QVERIFY(own.images[image].contradiction->share > surface.images[image].contradiction->share);
    }
  }

  /// The map of contradiction is written for each view, and its share and a note stand in the result.
  void contradictionsAreWritten() {
    const fs::path picture = root() / "picture.png";
    writePng(picture, standardImages({40, 30}).front().linear, 8);
    CompensateSettings settings;
    settings.image = picture;
    settings.out = root() / "shown";
    settings.target.views = {{}, {1.0, ViewPlacement::own, {}}};
    Progress silent;
    const CompensateResult result = compensate(statue(), settings, silent);
    QVERIFY(result.contradiction.has_value());
    QCOMPARE(result.contradiction->views.size(), std::size_t{3});
    QVERIFY(result.contradiction->share > 0.2);
    QCOMPARE(result.notes.size(), std::size_t{1});
    for (const char* name : {"contradiction.exr", "contradiction-2.png", "contradiction-3.exr"})
      QVERIFY(std::ranges::count(result.files, settings.out / name) == 1 && fs::exists(settings.out / name));
  }

  /// Law: each view is proved by its own photograph; one that differs from what was predicted is named. What
  /// is kept of it comes back.
  void aProofIsOfEveryView() {
    ProveSettings settings;
    settings.image = root() / "proved.png";
    writePng(settings.image, standardImages({40, 30}).front().linear, 8);
    settings.out = root() / "proof";
    Progress silent;
    const ProveResult result = proveCalibration(statue(), settings, cache(), silent);
    QCOMPARE(result.others.size(), std::size_t{2});
    bool areAll = true;
    for (std::size_t camera = 0; camera < 3; ++camera)
      areAll = areAll && isAsPredicted(viewOf(result, camera));
    QCOMPARE(isAsPredicted(result), areAll);
    QCOMPARE(viewThatDiffers(result).has_value(), !areAll);
    for (const ProvedView& view : result.others) {
      qInfo("measured %.1f dB, %.2f, predicted %.1f dB, %.2f", view.after.measured.psnr,
            view.after.measured.deltaE, view.after.predicted.psnr, view.after.predicted.deltaE);
      QVERIFY(view.after.measured.psnr > view.before.measured.psnr);
      QVERIFY(std::abs(view.after.measured.psnr - view.after.predicted.psnr) < 3.0);
      QVERIFY(view.reachable > 0.0 && view.after.surprise < 0.2);
    }
    for (const char* name : {"target-2.png", "before-3.exr", "after-2_delta_e.exr", "comparison-3.png"})
      QVERIFY(std::ranges::count(result.files, settings.out / name) == 1 && fs::exists(settings.out / name));
    ProofRecord record{"2026-01-02T03:04:05Z", "measured", "shown", {}, result};
    saveProofRecord(record, settings.out);
    const std::optional<ProofRecord> read = loadProofRecord(settings.out);
    QVERIFY(read && read->figures.others.size() == 2);
    QCOMPARE(read->figures.others[1].after.measured.deltaE, result.others[1].after.measured.deltaE);
    QCOMPARE(read->figures.others[0].reachable, result.others[0].reachable);
    record.figures.after.measured = record.figures.after.predicted;
    for (ProvedView& view : record.figures.others) view.after.measured = view.after.predicted;
    QVERIFY(isAsPredicted(record.figures));
    // A view that has moved is told by that, however coarse what was predicted.
    for (ProvedProjection* after : {&record.figures.after, &record.figures.others[0].after})
      after->measured.deltaE = after->predicted.deltaE = 5.0;
    for (sentinels::Movement* moved : {&record.figures.moved, &record.figures.others[0].moved})
      for (double pixels : {0.5 * plainShift, 2.0 * plainShift})
        for (bool explains : {false, true}) {
          *moved = {0.0, pixels, 0.0, explains};
          QCOMPARE(isAsPredicted(record.figures), !explains || pixels < plainShift);
          *moved = {};
        }
    record.figures.others[1].after.measured.deltaE = 100.0;
    QCOMPARE(viewThatDiffers(record.figures), std::optional<std::size_t>(2));
    QVERIFY(!isAsPredicted(record.figures));
  }

  /// What several projectors are solved together for: blended from separate solves the dome is at least 3 dB
  /// worse, and its seams are seen.
  void theDomeIsSolvedTogether() {
    if (isSanitized) QSKIP("qualities are compared without sanitizers; others run this code there");
    const EvaluateResult& result = domeEvaluated();
    double joint = 0.0, blended = 0.0;
    for (const ImageScore& image : result.images) {
      joint += psnrOf(image.methods) + psnrOf(image.others[0].methods);
      blended += image.blended->psnrReachable + image.others[0].blended->psnrReachable;
    }
    const double views = 2.0 * static_cast<double>(result.images.size());
    qInfo("%.2f dB together, %.2f dB blended", joint / views, blended / views);
    for (const SeamScore& seams : result.seams)
      qInfo("%.0f %% grey: seams %.2f (95 %% below %.2f, elsewhere %.2f) together, %.2f (%.2f, %.2f) blended",
            100.0 * seams.grey, seams.joint.mean, seams.joint.p95, seams.joint.elsewhere, seams.blended.mean,
            seams.blended.p95, seams.blended.elsewhere);
    QVERIFY(joint / views > blended / views + 3.0);
    // What is asked for nearly all light there is has the seams: its neighbours' light is not to be had for
    // it.
    for (const SeamScore& seams : result.seams) {
      qInfo("%.0f %% grey: 95 %% below %.2f where light is left", 100.0 * seams.grey, seams.roomy.p95);
      QVERIFY(seams.joint.mean < 1.0 && seams.roomy.p95 < 1.5);
      QVERIFY(seams.roomy.p95 <= seams.joint.p95 + 0.05);
    }
  }
};

QTEST_GUILESS_MAIN(TestSeveralViews)
#include "test_several_views.moc"
