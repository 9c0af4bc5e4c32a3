// SPDX-License-Identifier: MIT
#include <QtTest>
#include <cmath>

#include "relucent/base/random.h"
#include "relucent/hdr/isotonic.h"
#include "relucent/linearization/linearization.h"

using namespace relucent;
using namespace relucent::hdr;
using namespace relucent::image;
using namespace relucent::linearization;

namespace {

ProjectorResponse gammas(double red, double green, double blue) {
  ProjectorResponse response;
  std::size_t c = 0;
  for (double gamma : {red, green, blue}) {
    std::vector<double> x, y;
    for (int i = 0; i <= 64; ++i) {
      x.push_back(i / 64.0 * i / 64.0);
      y.push_back(std::pow(x.back(), gamma));
    }
    response.channels[c++] = ResponseCurve(x, y);
  }
  return response;
}

ProjectorResponse crushed() {
  std::vector<double> x, y;
  for (int i = 0; i <= 32; ++i) {
    x.push_back(i / 32.0);
    y.push_back(std::clamp((x.back() - 0.2) / 0.6, 0.0, 1.0));
  }
  ProjectorResponse response;
  response.channels.fill(curveFromRamp(x, y, std::vector<double>(x.size(), 1.0)));
  return response;
}

Image noiseImage(Size size) {
  Image image(size, 3);
  Random random{5};
  for (float& value : image.data()) {
    float u = random.uniformFloat();
    value = u * u;
  }
  return image;
}

}  // namespace

class TestProjectorResponse : public QObject {
  Q_OBJECT

 private slots:
  void decodeUndoesEncode_data() {
    QTest::addColumn<int>("width");
    QTest::addColumn<bool>("smooth");
    for (int width : {31, 257}) {
      QTest::addRow("%d wide, smooth", width) << width << true;
      QTest::addRow("%d wide, crushed and clipped", width) << width << false;
    }
  }
  void decodeUndoesEncode() {
    QFETCH(int, width);
    QFETCH(bool, smooth);
    ProjectorResponse response = smooth ? gammas(1.0, 2.2, 2.6) : crushed();
    Image linear = noiseImage({width, 67});
    Image back = response.decode(response.encode(linear));
    for (std::size_t i = 0; i < linear.data().size(); ++i) {
      // As the header promises; single precision drive alone is good for 3e-7 of light.
      double bound = smooth ? 1e-6 : std::sqrt(linear.data()[i]) / 2000.0 + 1e-6;
      QVERIFY2(std::abs(back.data()[i] - linear.data()[i]) <= bound,
               qPrintable(QString("%1 came back as %2").arg(linear.data()[i]).arg(back.data()[i])));
    }
  }

  void endsAreExactAndValuesClamped_data() {
    QTest::addColumn<int>("width");
    QTest::newRow("small: exact") << 3;
    QTest::newRow("large: tables") << 5000;
  }
  void endsAreExactAndValuesClamped() {
    QFETCH(int, width);
    ProjectorResponse response = gammas(1.8, 2.2, 2.4);
    for (auto [value, wanted] : {std::pair{0.0f, 0.0f}, {1.0f, 1.0f}, {-0.5f, 0.0f}, {7.0f, 1.0f}}) {
      Image image({width, 1}, 3, value);
      QCOMPARE(response.encode(image), Image({width, 1}, 3, wanted));
      QCOMPARE(response.decode(image), Image({width, 1}, 3, wanted));
    }
  }

  void encodingAscends() {
    Image ramp({8000, 1}, 3);
    for (int x = 0; x < 8000; ++x)
      for (int c = 0; c < 3; ++c) ramp.at(x, 0, c) = static_cast<float>(x) / 7999.0f;
    Image encoded = crushed().encode(ramp);
    for (int x = 1; x < 8000; ++x) QVERIFY(encoded.at(x, 0, 1) >= encoded.at(x - 1, 0, 1));
  }

  void identityChangesNothing() {
    Image image = noiseImage({20, 20});
    QCOMPARE(ProjectorResponse().encode(image), image);
    QCOMPARE(ProjectorResponse().decode(image), image);
  }
};

QTEST_APPLESS_MAIN(TestProjectorResponse)
#include "test_projector_response.moc"
