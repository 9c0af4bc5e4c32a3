// SPDX-License-Identifier: MIT
#include "relucent/mapping/cube_lut.h"

#include <QtTest>
#include <sstream>

#include "relucent/image/colour.h"

using namespace relucent;
using namespace relucent::mapping;

class TestCubeLut : public QObject {
  Q_OBJECT

 private slots:
  /// At each of its entries the table is the response.
  void drivesEmitTheLightThatIsWanted() {
    linearization::ProjectorResponse response;
    const std::array<double, 3> exponents{1.0, 1.8, 2.4};
    for (std::size_t c = 0; c < 3; ++c) {
      std::vector<double> drive, light;
      for (int i = 0; i <= 32; ++i) {
        drive.push_back(i / 32.0);
        light.push_back(std::pow(i / 32.0, exponents[c]));
      }
      response.channels[c] = hdr::ResponseCurve(drive, light);
    }
    constexpr int side = 9;
    std::istringstream lines(cubeLut(response, "test", side));
    std::string line;
    std::getline(lines, line);
    QCOMPARE(line, std::string("TITLE \"test\""));
    std::getline(lines, line);
    QCOMPARE(line, std::string("LUT_3D_SIZE 9"));
    for (int blue = 0; blue < side; ++blue)
      for (int green = 0; green < side; ++green)
        for (int red = 0; red < side; ++red) {
          std::array<double, 3> drive{};
          lines >> drive[0] >> drive[1] >> drive[2];
          QVERIFY(!lines.fail());
          const std::array<int, 3> wanted{red, green, blue};
          for (std::size_t c = 0; c < 3; ++c) {
            const double light = image::srgbDecode(wanted[c] / (side - 1.0));
            // Six decimals of drive, where the steepest curve has a slope of 2.4.
            QVERIFY(std::abs(response.channels[c](drive[c]) - light) < 3e-6);
          }
        }
    std::getline(lines, line);
    QVERIFY(!std::getline(lines, line));
  }
};

QTEST_APPLESS_MAIN(TestCubeLut)
#include "test_cube_lut.moc"
