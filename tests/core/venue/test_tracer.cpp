// SPDX-License-Identifier: MIT
#include <tbb/global_control.h>

#include <Eigen/Geometry>
#include <QTest>
#include <cmath>
#include <numbers>

#include "relucent/venue/scenes.h"
#include "relucent/venue/traced_transport.h"
#include "relucent/venue/tracer.h"

using namespace relucent;
using namespace relucent::venue;
using Eigen::Vector2f;
using Eigen::Vector3f;

namespace {

constexpr float pi = std::numbers::pi_v<float>;

Surface grey(Mesh mesh, float reflectance) {
  return {std::move(mesh), {plainColour(Eigen::Array3f::Constant(reflectance))}};
}

ProjectorOptics projectorAt(const Vector3f& position, const Vector3f& target, Size raster, float throwRatio) {
  ProjectorOptics projector;
  projector.raster = raster;
  projector.pose = Pose::lookingAt(position, target);
  projector.throwRatio = throwRatio;
  projector.focus = (target - position).norm();
  projector.aperture = 1e-4f;
  return projector;
}

CameraOptics cameraAt(const Vector3f& position, const Vector3f& target, Size raster, float throwRatio) {
  return {raster, Pose::lookingAt(position, target), throwRatio};
}

/// A camera pixel's signal while everything is lit, in one band (scenes here are grey).
double floodOf(const TransportRow& row) {
  double sum = 0.0;
  for (const TransportRow::Entry& entry : row.entries()) sum += static_cast<double>(entry.transport[0]);
  return sum;
}

double floodOf(const Tracer& tracer, std::size_t pixel) {
  TransportRow row;
  tracer.trace(pixel, row);
  return floodOf(row);
}

double meanFlood(const Scene& scene, const TracerSettings& settings) {
  Tracer tracer(scene, settings);
  double sum = 0.0;
  for (std::size_t pixel = 0; pixel < scene.cameras[0].raster.count(); ++pixel) sum += floodOf(tracer, pixel);
  return sum / static_cast<double>(scene.cameras[0].raster.count());
}

/// Share of the light leaving a diffuse polygon's directions as seen from a surface element: Lambert's
/// formula,
///   F = 1 / (2 pi) sum_i angle(v_i, v_i+1) n . (v_i x v_i+1) / |v_i x v_i+1|
double polygonFormFactor(const Vector3f& point, const Vector3f& normal,
                         const std::vector<Vector3f>& corners) {
  double sum = 0.0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    Eigen::Vector3d a = (corners[i] - point).cast<double>().normalized();
    Eigen::Vector3d b = (corners[(i + 1) % corners.size()] - point).cast<double>().normalized();
    Eigen::Vector3d across = a.cross(b);
    sum += std::atan2(across.norm(), a.dot(b)) * across.normalized().dot(normal.cast<double>());
  }
  return std::abs(sum) / (2.0 * std::numbers::pi);
}

void compare(const char* what, double found, double expected, double tolerance) {
  double residual = found / expected - 1.0;
  qInfo("%s: %.5f, closed form %.5f, residual %+.2f %%", what, found, expected, 100.0 * residual);
  QVERIFY2(std::abs(residual) <= tolerance,
           qPrintable(QString("%1: %2 is not %3").arg(what).arg(found).arg(expected)));
}

}  // namespace

class TestTracer : public QObject {
  Q_OBJECT
 private slots:
  void planeAtTheFocus_data() {
    QTest::addColumn<float>("vignetting");
    QTest::newRow("even") << 0.0f;
    QTest::newRow("vignetting") << 0.3f;
  }
  /// A white screen at the focus has transport 1, less vignetting, however far from the axis.
  void planeAtTheFocus() {
    QFETCH(float, vignetting);
    Scene scene;
    scene.surfaces.push_back(grey(rectangle({-3, -3, 0}, {6, 0, 0}, {0, 6, 0}), 1.0f));
    scene.projectors.push_back(projectorAt({0, 0, 2}, {0, 0, 0}, {64, 48}, 1.0f));
    scene.projectors[0].vignetting = vignetting;
    scene.cameras = {cameraAt({0, 0, 2}, {0, 0, 0}, {32, 24}, 1.1f)};
    Tracer tracer(scene, {.pathsPerPixel = 64});
    compare("centre", floodOf(tracer, 12 * 32 + 16), 1.0, 0.002);
    // The camera's pixel (0.5, 0.5) sees the screen at this share of the picture's half diagonal.
    Vector2f place((0.5f / 32.0f - 0.5f) / 1.1f, (0.5f * 0.75f - 0.5f / 32.0f) / 1.1f);
    double share = static_cast<double>(place.squaredNorm()) / (0.25 + 0.25 * 0.75 * 0.75);
    compare("corner", floodOf(tracer, 0), 1.0 - static_cast<double>(vignetting) * share, 0.005);
  }

  void shadowsOfTwoProjectors_data() {
    QTest::addColumn<float>("place");
    QTest::addColumn<bool>("fromLeft");
    QTest::addColumn<bool>("fromRight");
    // The shadow's edges lie at (3 b + 0.5 * 1.5) / 2.5 for the bar's edges b = -0.1 and 0.1: 0.18 and 0.42.
    QTest::newRow("beside all shadows") << 0.43f << true << true;
    QTest::newRow("within the left one's") << 0.41f << false << true;
    QTest::newRow("within it, inner edge") << 0.19f << false << true;
    QTest::newRow("between the shadows") << 0.17f << true << true;
    QTest::newRow("within the right one's") << -0.41f << true << false;
    QTest::newRow("beside, at the left") << -0.43f << true << true;
  }
  /// A bar before a wall throws a shadow for each of two projectors, where the other one shines. The edge of
  /// a shadow, for a projector at (a, 0, d) and the bar's edge at (b, h): similar triangles,
  ///   x = (d b - h a) / (d - h)
  /// and what is lit has irradiance focus^2 / (cos^3 r^2) times the cosine at the wall.
  void shadowsOfTwoProjectors() {
    QFETCH(float, place);
    QFETCH(bool, fromLeft);
    QFETCH(bool, fromRight);
    Scene scene;
    scene.surfaces.push_back(grey(rectangle({-3, -3, 0}, {6, 0, 0}, {0, 6, 0}), 0.6f));
    scene.surfaces.push_back(grey(rectangle({-0.1f, -3, 0.5f}, {0.2f, 0, 0}, {0, 6, 0}), 0.6f));
    for (float side : {-1.5f, 1.5f})
      scene.projectors.push_back(projectorAt({side, 0, 3}, {0, 0, 0}, {64, 48}, 1.5f));
    Vector3f point(place, 0, 0);
    scene.cameras = {cameraAt({place, 0, 2}, point, {1, 1}, 1000.0f)};
    Tracer tracer(scene, {.pathsPerPixel = 64, .longestPath = 0});
    TransportRow row;
    tracer.trace(0, row);
    double found[2] = {0.0, 0.0};
    for (const TransportRow::Entry& entry : row.entries())
      found[entry.node.projector] += static_cast<double>(entry.transport[0]);
    const bool lit[2] = {fromLeft, fromRight};
    for (std::size_t i = 0; i < 2; ++i) {
      const ProjectorOptics& projector = scene.projectors[i];
      Vector3f way = point - projector.pose.position;
      float distance = way.norm(), cosine = projector.pose.forward.dot(way) / distance;
      float expected = 0.6f * projector.focus * projector.focus / (cosine * cosine * cosine) /
                       (distance * distance) * (-way.z() / distance);
      if (lit[i])
        compare(i == 0 ? "left" : "right", found[i], static_cast<double>(expected), 0.002);
      else
        QCOMPARE(found[i], 0.0);
    }
  }

  void insideOfSphere_data() {
    QTest::addColumn<float>("reflectance");
    for (float reflectance : {0.3f, 0.6f, 0.8f})
      QTest::addRow("%g", static_cast<double>(reflectance)) << reflectance;
  }
  /// Inside a diffuse sphere light that has bounced is the same everywhere:
  ///   E = rho / (1 - rho) * flux / (4 pi R^2)
  /// This is energy conservation as well: what is absorbed, (1 - rho) E over the wall, is what was emitted.
  void insideOfSphere() {
    QFETCH(float, reflectance);
    constexpr float radius = 2.0f;
    Scene scene;
    scene.surfaces.push_back(grey(ellipsoid(Vector3f::Zero(), Vector3f::Constant(radius), 256), reflectance));
    scene.projectors.push_back(projectorAt({0.2f, 0.1f, 0}, {0, 0, -1.5f}, {64, 48}, 0.5f));
    scene.cameras = {cameraAt({0, 0.1f, 0.3f}, {0, 0, 2}, {1, 1}, 100.0f)};

    double focus = static_cast<double>(scene.projectors[0].focus), rho = static_cast<double>(reflectance);
    double flux = focus * focus / 0.25 * 0.75;  // irradiance 1 over the picture at the focus
    double indirect = rho / (1.0 - rho) * flux / (4.0 * std::numbers::pi * radius * radius);
    // The first bounce is spread well over 65536 paths, later ones are random: most of the light at 0.8.
    double found = meanFlood(scene, {.pathsPerPixel = 65536, .longestPath = 100});
    compare("unlit wall", found, rho * indirect, 0.02);
  }

  void twoPatches_data() {
    QTest::addColumn<float>("height");
    QTest::addColumn<float>("along");
    QTest::newRow("near the edge") << 0.1f << 0.5f;
    QTest::newRow("middle") << 0.5f << 0.5f;
    QTest::newRow("aside") << 0.4f << 0.9f;
  }
  /// Two perpendicular patches with a common edge, one lit evenly: the other gets the reflectance times the
  /// form factor.
  void twoPatches() {
    QFETCH(float, height);
    QFETCH(float, along);
    Scene scene;
    scene.surfaces.push_back(grey(rectangle({0, 0, 0}, {0, 0, 1}, {1, 0, 0}), 0.7f));
    scene.surfaces.push_back(grey(rectangle({0, 0, 0}, {0, 1, 0}, {0, 0, 1}), 0.5f));
    ProjectorOptics projector;
    projector.raster = {64, 64};
    projector.pose = {{0.5f, 3, 0.5f}, {1, 0, 0}, {0, 0, -1}, {0, -1, 0}};
    projector.throwRatio = 3.0f;
    projector.focus = 3.0f;
    projector.aperture = 1e-4f;
    scene.projectors.push_back(projector);
    Vector3f place(0, height, along);
    scene.cameras = {cameraAt({2, height, along}, place, {1, 1}, 200.0f)};
    double factor = polygonFormFactor(place, {1, 0, 0}, {{0, 0, 0}, {1, 0, 0}, {1, 0, 1}, {0, 0, 1}});
    // 16384 well-spread paths, of which a third arrives.
    double found = meanFlood(scene, {.pathsPerPixel = 16384, .longestPath = 1}) / (0.7 * 0.5);
    compare("form factor", found, factor, 0.005);
  }

  /// Swapping camera and projector swaps rows and columns, up to the solid angles of their pixels
  /// (Helmholtz):
  ///   T[i, j] a_i / focus^2 is the same both ways, a_i: pixel area on the plane at distance 1.
  /// Summed over all pixels, for direct and for bounced light.
  void reciprocity() {
    VenueSettings settings;
    settings.projector = {16, 12};
    settings.camera = {16, 12};
    settings.devices.vignetting = 0.0;
    Scene there = buildScene(settings);
    there.projectors[0].aperture = 1e-4f;
    Scene back = there;
    back.cameras = {{there.projectors[0].raster, there.projectors[0].pose, there.projectors[0].throwRatio}};
    back.projectors[0].pose = there.cameras[0].pose;
    back.projectors[0].throwRatio = there.cameras[0].throwRatio;

    auto sums = [](const Scene& scene) {
      Tracer tracer(scene, {.pathsPerPixel = 2048});
      double direct = 0.0, bounced = 0.0;
      for (std::size_t pixel = 0; pixel < scene.cameras[0].raster.count(); ++pixel) {
        TransportRow row;
        tracer.trace(pixel, row);
        for (const TransportRow::Entry& entry : row.entries())
          (entry.node.level == 0 ? direct : bounced) += static_cast<double>(entry.transport.sum());
      }
      double ratio = static_cast<double>(scene.cameras[0].throwRatio *
                                         static_cast<float>(scene.cameras[0].raster.width));
      return std::pair(direct / (ratio * ratio), bounced / (ratio * ratio));
    };
    auto [directThere, bouncedThere] = sums(there);
    auto [directBack, bouncedBack] = sums(back);
    // 192 pixels of 2048 paths, and the camera's blur across the borders of both pictures.
    compare("direct light, swapped", directBack, directThere, 0.005);
    compare("bounced light, swapped", bouncedBack, bouncedThere, 0.01);
  }

  void blurCircle_data() {
    QTest::addColumn<float>("depth");
    for (float depth : {1.2f, 1.6f, 2.6f, 3.5f}) QTest::addRow("%g m", static_cast<double>(depth)) << depth;
  }
  /// A point out of focus is lit by a disc of the picture: diameter aperture |d - f| / f at depth d.
  void blurCircle() {
    QFETCH(float, depth);
    Scene scene;
    scene.surfaces.push_back(grey(rectangle({-3, -3, -depth}, {6, 0, 0}, {0, 6, 0}), 0.5f));
    scene.projectors.push_back(projectorAt({0, 0, 0}, {0, 0, -2}, {512, 512}, 1.0f));
    ProjectorOptics& projector = scene.projectors[0];
    projector.aperture = 0.08f;
    scene.cameras = {cameraAt({0.2f, 0, 0}, {0.003f, 0.002f, -depth}, {1, 1}, 1e5f)};
    Tracer tracer(scene, {.pathsPerPixel = 4096, .longestPath = 0});
    TransportRow row;
    tracer.trace(0, row);
    double weight = 0.0, mean = 0.0, square = 0.0;
    for (const TransportRow::Entry& entry : row.entries()) {
      double x = entry.node.x, w = static_cast<double>(entry.transport[0]);
      weight += w;
      mean += w * x;
      square += w * x * x;
    }
    mean /= weight;
    // A disc of diameter c has variance c^2 / 16; counting whole pixels adds 1 / 12.
    double variance = square / weight - mean * mean - 1.0 / 12.0;
    double found = 4.0 * std::sqrt(variance);
    double pixel = static_cast<double>(depth) / 512.0;
    double expected = 0.08 * std::abs(static_cast<double>(depth) - 2.0) / 2.0 / pixel;
    compare("blur in projector pixels", found, expected, 0.02);
  }

  /// A pane of glass lets (1 - R) / (1 + R) through, R = ((n - 1) / (n + 1))^2, reflections inside included.
  void glassPane() {
    auto scene = [](bool pane) {
      Scene result;
      result.surfaces.push_back(grey(rectangle({-3, -3, 0}, {6, 0, 0}, {0, 6, 0}), 0.8f));
      if (pane) {
        Material glass{plainColour({0, 0, 0})};
        glass.refractiveIndex = 1.5f;
        result.surfaces.push_back({box({0, -0.5f, 2.5f}, {1, 1, 0.02f}, 0.0f), glass});
      }
      result.projectors.push_back(projectorAt({0, 0, 3}, {0, 0, 0}, {64, 64}, 3.0f));
      result.cameras = {cameraAt({0.2f, 0, 1.5f}, {0, 0, 0}, {16, 16}, 6.0f)};
      return result;
    };
    Scene clear = scene(false), paned = scene(true);
    TracerSettings settings{.pathsPerPixel = 64, .longestPath = 0, .photonsPerPixel = 64};
    double through = meanFlood(paned, settings) / meanFlood(clear, settings);
    // The pane spreads nothing, but the photons are counted: 64 a pixel over some 700 pixels.
    compare("pane of glass", through, 0.96 / 1.04, 0.01);
  }

  /// Nodes may be merged, energy may not go anywhere.
  void condensingKeepsEnergy() {
    TransportRow row;
    for (int y = 0; y < 32; ++y)
      for (int x = 0; x < 32; ++x) row.add({0, 1, x, y}, Spectrum::Constant(static_cast<float>(x * y + 1)));
    row.add({0, 0, 3, 3}, Spectrum::Constant(0.5f));
    double before = floodOf(row);
    row.condense(0.01f, 1, 6);
    QVERIFY(std::abs(floodOf(row) / before - 1.0) < 1e-5);
    QVERIFY2(row.entries().size() < 400, qPrintable(QString::number(row.entries().size())));
    // What is finer than may be merged stays.
    auto fine = std::count_if(row.entries().begin(), row.entries().end(),
                              [](const TransportRow::Entry& entry) { return entry.node.level == 0; });
    QCOMPARE(fine, 1);
  }

  /// Law: another camera beside it, of another size, changes nothing for the first; where both stand in one
  /// place they see the same, up to their paths.
  void camerasAreTracedForThemselves() {
    VenueSettings settings;
    settings.projector = {32, 24};
    settings.camera = {16, 12};
    Scene alone = buildScene(settings), both = alone;
    both.cameras.push_back(alone.cameras.front());
    both.cameras.push_back(alone.cameras.front());
    both.cameras[1].raster = {8, 6};
    const TracerSettings settingsOfTracer{.pathsPerPixel = 256};
    const Tracer one(alone, settingsOfTracer), three(both, settingsOfTracer);
    QCOMPARE(three.cameras(), Rasters(std::vector<Size>{{16, 12}, {8, 6}, {16, 12}}));
    double first = 0.0, third = 0.0;
    for (std::size_t pixel = 0; pixel < 192; ++pixel) {
      TransportRow expected, found, again;
      one.trace(pixel, expected);
      three.trace(pixel, found);
      QCOMPARE(floodOf(found), floodOf(expected));
      QCOMPARE(found.entries().size(), expected.entries().size());
      three.trace(192 + 48 + pixel, again);
      first += floodOf(found);
      third += floodOf(again);
    }
    // 0.7 % of a pixel's flood by its paths (core/venue/README.md), of the mean of 192 less.
    compare("the same place", third / first, 1.0, 0.003);
  }

  void sameForEveryNumberOfThreads() {
    VenueSettings settings;
    settings.name = "glass";
    settings.projector = {32, 24};
    settings.camera = {16, 12};
    Scene scene = buildScene(settings);
    TracerSettings tracer{.pathsPerPixel = 16};
    Progress progress;
    TracedTransport many = traceTransport(scene, tracer, 60.0, progress);
    tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    TracedTransport single = traceTransport(scene, tracer, 60.0, progress);
    QVERIFY(many.cameraByNode == single.cameraByNode);
    QVERIFY(many.roomLight == single.roomLight);
  }
};

QTEST_APPLESS_MAIN(TestTracer)
#include "test_tracer.moc"
