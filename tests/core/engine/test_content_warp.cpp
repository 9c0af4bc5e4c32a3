// SPDX-License-Identifier: MIT
#include "relucent/engine/content_warp.h"

#include <QtTest>
#include <cmath>

#include "core/inverse/synthetic_transport.h"

using namespace relucent;
using namespace relucent::compensation;
using namespace relucent::engine;
using namespace relucent::image;
using namespace relucent::synthetic;

namespace {

float applied(const ContentWarp& warp, const Image& content, std::size_t pixel, int channel) {
  const ContentWarp::Footprint& f = warp.footprints()[pixel];
  float sum = 0.0f;
  std::size_t weight = f.weight;
  for (int y = f.y; y < f.y + f.height; ++y)
    for (int x = f.x; x < f.x + f.width; ++x)
      sum += static_cast<float>(warp.weights()[weight++]) * content.at(x, y, channel);
  return f.scale * sum;
}

}  // namespace

class TestContentWarp : public QObject {
  Q_OBJECT

 private slots:
  void equalsPlacing_data() {
    QTest::addColumn<int>("width");
    QTest::addColumn<int>("height");
    QTest::addColumn<QString>("placement");
    for (auto [width, height] : {std::pair{40, 30}, {1, 1}, {3, 200}, {333, 77}, {1301, 901}})
      for (const char* placement : {"upright", "perspective", "fit", "cover", "beyond the view"})
        QTest::addRow("%dx%d %s", width, height, placement) << width << height << placement;
  }
  /// The same means as place() takes, at whatever size and shape.
  void equalsPlacing() {
    QFETCH(int, width);
    QFETCH(int, height);
    QFETCH(QString, placement);
    const Size view{31, 23};
    Corners corners = uprightCorners(4, 3, 20, 15);
    if (placement != "upright") corners = {{{3.5, 4}, {27, 1}, {29.2, 21}, {1, 17}}};
    if (placement == "beyond the view") corners = {{{-5, -3}, {40, 2}, {35, 30}, {2, 25}}};
    Placement where{corners, {}};
    double aspect = static_cast<double>(width) / height;
    if (placement == "fit") where = fitted(corners, aspect, Fit::fit);
    if (placement == "cover") where = fitted(corners, aspect, Fit::cover);
    Image content(Size{width, height}, 3);
    Random random{7};
    for (float& value : content.data()) value = random.uniformFloat();
    Placed expected = place(content, where, view);
    ContentWarp warp(content.size(), where, view);
    for (std::size_t pixel = 0; pixel < view.count(); ++pixel) {
      QCOMPARE(warp.inside(pixel), expected.inside[pixel] != 0);
      if (!warp.inside(pixel)) continue;
      // Weights are rounded to 1/65535 of the largest; a thousand single floats added up in another order.
      for (int c = 0; c < 3; ++c)
        QVERIFY(std::abs(applied(warp, content, pixel, c) -
                         expected.image.pixel(pixel)[static_cast<std::size_t>(c)]) < 1e-4f);
    }
  }

  /// Each view has its own placement, or none where the content lies on no surface that it knows.
  void eachViewHasItsPlacement() {
    const Rasters cameras({{31, 23}, {17, 19}, {20, 13}});
    const Placement first{{{{3.5, 4}, {27, 1}, {29.2, 21}, {1, 17}}}, {}},
        third{uprightCorners(2, 2, 16, 9), {}};
    const Size content{40, 30};
    const ContentWarp warp(content, {first, std::nullopt, third}, cameras, {});
    QCOMPARE(warp.footprints().size(), cameras.count());
    Image picture(content, 3);
    Random random{7};
    for (float& value : picture.data()) value = random.uniformFloat();
    for (std::size_t camera : {0, 1, 2}) {
      const ContentWarp alone(content, camera == 0 ? first : third, cameras.size(camera));
      for (std::size_t pixel = 0; pixel < cameras.size(camera).count(); ++pixel) {
        const std::size_t row = cameras.offset(camera) + pixel;
        QCOMPARE(warp.inside(row), camera != 1 && alone.inside(pixel));
        if (warp.inside(row)) QCOMPARE(applied(warp, picture, row, 1), applied(alone, picture, pixel, 1));
      }
    }
  }

  void whiteStaysWhite() {
    Size size{1920, 1080};
    ContentWarp warp(size, {uprightCorners(2, 2, 16, 9), {}}, {20, 13});
    Image white(size, 3, 1.0f);
    int inside = 0;
    for (std::size_t pixel = 0; pixel < 260; ++pixel) {
      if (!warp.inside(pixel)) continue;
      ++inside;
      // 14400 weights added up in single floats.
      QVERIFY(std::abs(applied(warp, white, pixel, 0) - 1.0f) < 1e-4f);
    }
    QCOMPARE(inside, 16 * 9);
  }
};

QTEST_GUILESS_MAIN(TestContentWarp)
#include "test_content_warp.moc"
