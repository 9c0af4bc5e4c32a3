// SPDX-License-Identifier: MIT
#include <QtTest>
#include <array>
#include <functional>
#include <limits>

#include "relucent/acquisition/photograph_review.h"
#include "relucent/base/random.h"

using namespace relucent;
using namespace relucent::acquisition;
using namespace relucent::multiplexing;

namespace {

constexpr std::size_t photographs = 6, rows = 400;
constexpr float deviation = 0.01f;

/// What a camera pixel shows of patterns that are predicted exactly, but for noise.
struct Seen {
  RowLight light;
  Eigen::ArrayX3f predictions;

  explicit Seen(std::size_t row) : predictions(photographs, 3) {
    Random random{5, row};
    light.light.setConstant(3 + photographs, 3, 1.0f);
    light.variance.setConstant(3 + photographs, 3, deviation * deviation);
    for (Eigen::Index n = 0; n < predictions.rows(); ++n)
      for (Eigen::Index c = 0; c < 3; ++c) {
        predictions(n, c) = 0.2f + 0.6f * random.uniformFloat();
        light.light(3 + n, c) = predictions(n, c) + deviation * static_cast<float>(random.normal());
      }
  }
};

PhotographReview reviewed(const std::function<void(std::size_t row, Seen& seen)>& change) {
  PhotographReview review(photographs);
  for (std::size_t row = 0; row < rows; ++row) {
    Seen seen(row);
    change(row, seen);
    review.add(row, seen.light, seen.predictions, 0.0f);
  }
  return review;
}

}  // namespace

class TestPhotographReview : public QObject {
  Q_OBJECT

 private slots:
  void lampIsMeasuredRelativeToAll_data() {
    QTest::addColumn<float>("common");
    for (float common : {1.0f, 0.95f, 1.05f})
      QTest::addRow("all at %g", static_cast<double>(common)) << common;
  }
  /// What all photographs have in common is not theirs to say.
  void lampIsMeasuredRelativeToAll() {
    QFETCH(float, common);
    const std::array<float, photographs> lamp{1.0f, 1.01f, 0.99f, 1.003f, 0.997f, 1.0f};
    PhotographReview review = reviewed([&](std::size_t, Seen& seen) {
      for (std::size_t n = 0; n < photographs; ++n)
        seen.light.light.row(static_cast<Eigen::Index>(3 + n)) *= common * lamp[n];
    });
    std::vector<float> gains = review.gains();
    for (std::size_t n = 0; n < photographs; ++n)
      // 1200 values with noise of 1 % of the flood, which is twice the mean prediction: 0.0006, five times.
      QVERIFY2(std::abs(gains[n] - lamp[n]) < 0.003f, qPrintable(QString::number(gains[n])));
    QVERIFY(review.spoilt().empty());
  }

  void whatIsSpoiltIsFoundAndChangesNoGain_data() {
    QTest::addColumn<std::size_t>("covered");
    QTest::addColumn<bool>("found");
    QTest::newRow("2 %") << rows / 50 << true;
    QTest::newRow("half") << rows / 2 << true;
    QTest::newRow("one pixel") << std::size_t{1} << false;
  }
  void whatIsSpoiltIsFoundAndChangesNoGain() {
    QFETCH(std::size_t, covered);
    QFETCH(bool, found);
    PhotographReview review = reviewed([&](std::size_t row, Seen& seen) {
      if (row < covered) seen.light.light.row(3 + 2) = 0.0f;
    });
    QCOMPARE(review.spoilt(), found ? std::vector<std::size_t>{2} : std::vector<std::size_t>{});
    QCOMPARE(review.contradictions().size(), covered);
    for (auto [row, number] : review.contradictions()) QVERIFY(row < covered && number == 2);
    for (float gain : review.gains()) QVERIFY(std::abs(gain - 1.0f) < 0.005f);
  }

  void whatWasNotSeenContradictsNothing() {
    PhotographReview review = reviewed([](std::size_t, Seen& seen) {
      seen.light.light.row(3 + 1) = 40.0f;
      seen.light.variance.row(3 + 1) = std::numeric_limits<float>::infinity();
    });
    QVERIFY(review.contradictions().empty());
    for (float gain : review.gains()) QVERIFY(std::isfinite(gain));
  }

  void partsAreTheWhole() {
    PhotographReview whole = reviewed([](std::size_t, Seen&) {});
    PhotographReview sum(photographs);
    for (std::size_t part = 0; part < 4; ++part) {
      PhotographReview some(photographs);
      for (std::size_t row = part * rows / 4; row < (part + 1) * rows / 4; ++row) {
        Seen seen(row);
        some.add(row, seen.light, seen.predictions, 0.0f);
      }
      sum.add(some);
    }
    for (std::size_t n = 0; n < photographs; ++n)
      QVERIFY(std::abs(sum.gains()[n] - whole.gains()[n]) < 1e-6f);
  }
};

QTEST_APPLESS_MAIN(TestPhotographReview)
#include "test_photograph_review.moc"
