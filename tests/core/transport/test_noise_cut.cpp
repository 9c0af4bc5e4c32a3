// SPDX-License-Identifier: MIT
#include <QTest>

#include "relucent/transport/noise_cut.h"

using namespace relucent;
using namespace relucent::transport;

namespace {

/// Rows of one camera in a line: their light and the variance of their leaves, all channels alike.
Acquisition measured(const std::vector<float>& light, const std::vector<float>& variance) {
  Acquisition acquisition;
  std::vector<float> flood, noise;
  for (std::size_t row = 0; row < light.size(); ++row)
    for (int c = 0; c < 3; ++c) {
      flood.push_back(light[row]);
      noise.push_back(variance[row]);
    }
  acquisition.flood = CameraStack(std::move(flood));
  acquisition.leafVariance = CameraStack(std::move(noise));
  acquisition.flagged.assign(light.size(), 0);
  return acquisition;
}

}  // namespace

class TestNoiseCut : public QObject {
  Q_OBJECT

 private slots:
  void itIsSomeDeviationsOfATypicalRow() {
    const Acquisition acquisition = measured({1, 1, 1}, {1e-6f, 4e-6f, 9.0f});
    QVERIFY(std::abs(noiseCut(acquisition) - 3.0 * 2e-3) < 1e-9);
    QVERIFY(std::abs(noiseCut(acquisition, 1.0) - 2e-3) < 1e-9);
  }

  /// Law: what is not lit, and what is not relied on, says nothing of the noise.
  void darkAndFlaggedRowsDoNotCount() {
    Acquisition acquisition = measured({0, 1, 1}, {9.0f, 4e-6f, 9.0f});
    acquisition.flagged[2] = 1;
    QVERIFY(std::abs(noiseCut(acquisition, 1.0) - 2e-3) < 1e-9);
  }

  void unknownNoiseCutsNothing() {
    QCOMPARE(noiseCut(Acquisition()), 0.0);
    QCOMPARE(noiseCut(measured({0, 0}, {1.0f, 1.0f})), 0.0);
  }
};

QTEST_GUILESS_MAIN(TestNoiseCut)
#include "test_noise_cut.moc"
