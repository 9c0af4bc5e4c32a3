// SPDX-License-Identifier: MIT
#include "relucent/compensation/dense_box.h"

#include <QtTest>
#include <cmath>
#include <limits>

#include "core/compensation/scipy_reference.h"
#include "relucent/base/error.h"
#include "relucent/base/random.h"

using namespace relucent;
using namespace relucent::compensation;
using namespace relucent::reference;

namespace {

Progress quiet;

struct Sink : ProgressSink {
  void progressed(double fraction, const Message&) override { QVERIFY(fraction >= 0.0 && fraction <= 1.0); }
};

Eigen::MatrixXd randomMatrix(Eigen::Index rows, Eigen::Index columns, std::uint64_t seed) {
  Random random({seed});
  Eigen::MatrixXd a(rows, columns);
  for (Eigen::Index i = 0; i < a.size(); ++i) a.data()[i] = random.normal();
  return a;
}

Eigen::VectorXd randomVector(Eigen::Index rows, std::uint64_t seed) {
  return randomMatrix(rows, 1, seed + 1000);
}

}  // namespace

class TestDenseBox : public QObject {
  Q_OBJECT

 private slots:
  void agreesWithScipy_data() {
    QTest::addColumn<int>("index");
    std::vector<BoxCase> cases = boxCases("dense");
    QVERIFY(!cases.empty());
    for (std::size_t i = 0; i < cases.size(); ++i)
      QTest::newRow(qPrintable(cases[i].name)) << static_cast<int>(i);
  }
  void agreesWithScipy() {
    QFETCH(int, index);
    BoxCase c = boxCases("dense")[static_cast<std::size_t>(index)];
    DenseBoxResult result = solveDenseBox(c.a(), c.b, {}, quiet);
    QVERIFY2(result.converged, qPrintable(QString::number(result.optimality)));
    // An optimality of 1e-9 leaves f this near its least value; SciPy was asked for 1e-14.
    double error = std::abs(result.objective - c.objective);
    QVERIFY2(error < 1e-8 * (1.0 + c.objective), qPrintable(QString::number(error)));
    // Over the smallest singular value, 1e-3: a step of 1e-9 may be a thousandth of the way.
    if (c.unique)
      QVERIFY2((result.x - c.x).lpNorm<Eigen::Infinity>() < 1e-6,
               qPrintable(QString::number((result.x - c.x).lpNorm<Eigen::Infinity>())));
  }

  void meetsTheOptimalityConditions_data() {
    QTest::addColumn<int>("rows");
    QTest::addColumn<int>("columns");
    QTest::newRow("square") << 25 << 25;
    QTest::newRow("tall") << 90 << 40;
    QTest::newRow("wide") << 30 << 75;
    QTest::newRow("one by one") << 1 << 1;
  }
  /// KKT: the gradient is zero between the bounds, and points out of the box at them.
  void meetsTheOptimalityConditions() {
    QFETCH(int, rows);
    QFETCH(int, columns);
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
      Eigen::MatrixXd a = randomMatrix(rows, columns, seed);
      Eigen::VectorXd b = 3.0 * randomVector(rows, seed);
      DenseBoxSettings settings;
      settings.lower = -0.5;
      settings.upper = 0.25;
      DenseBoxResult result = solveDenseBox(a, b, settings, quiet);
      Eigen::VectorXd g = a.transpose() * (a * result.x - b);
      // The optimality is a step of 1e-9; the gradient is that times |a_j|^2, at most a few hundred here.
      for (Eigen::Index j = 0; j < g.size(); ++j) {
        QVERIFY(result.x[j] >= settings.lower && result.x[j] <= settings.upper);
        if (result.x[j] > settings.lower) QVERIFY2(g[j] < 1e-6, qPrintable(QString::number(g[j])));
        if (result.x[j] < settings.upper) QVERIFY2(g[j] > -1e-6, qPrintable(QString::number(g[j])));
      }
    }
  }

  void emptyAndZeroProblemsHaveResults() {
    QCOMPARE(solveDenseBox(Eigen::MatrixXd(5, 0), Eigen::VectorXd::Ones(5), {}, quiet).x.size(), 0);
    DenseBoxResult noRows = solveDenseBox(Eigen::MatrixXd(0, 4), Eigen::VectorXd(0), {}, quiet);
    QCOMPARE(noRows.x.size(), 4);
    QVERIFY(noRows.converged && noRows.x.isZero());
    DenseBoxResult zero =
        solveDenseBox(Eigen::MatrixXd::Zero(6, 4), Eigen::VectorXd::Constant(6, 2.0), {}, quiet);
    QVERIFY(zero.converged && zero.x.isZero());
    QCOMPARE(zero.objective, 12.0);
  }

  void saysWhatIsNotFinite() {
    Eigen::MatrixXd a = randomMatrix(5, 3, 1);
    Eigen::VectorXd b = randomVector(5, 1);
    b[2] = std::numeric_limits<double>::quiet_NaN();
    QVERIFY_EXCEPTION_THROWN(solveDenseBox(a, b, {}, quiet), Error);
    b[2] = 0.0;
    a(1, 1) = std::numeric_limits<double>::infinity();
    QVERIFY_EXCEPTION_THROWN(solveDenseBox(a, b, {}, quiet), Error);
    QVERIFY_EXCEPTION_THROWN(solveDenseBox(a, Eigen::VectorXd::Zero(4), {}, quiet), std::logic_error);
  }

  void stopsWhenAsked() {
    Eigen::MatrixXd a = randomMatrix(30, 20, 3);
    Eigen::VectorXd b = 3.0 * randomVector(30, 3);
    Sink sink;
    StopRequest keep;
    keep.ask(StopRequest::Kind::keep);
    Progress kept(sink, keep);
    DenseBoxResult early = solveDenseBox(a, b, {}, kept);
    QVERIFY(early.x.minCoeff() >= 0.0 && early.x.maxCoeff() <= 1.0);
    QVERIFY(!early.converged);
    StopRequest cancel;
    cancel.ask(StopRequest::Kind::cancel);
    Progress cancelled(sink, cancel);
    QVERIFY_EXCEPTION_THROWN(solveDenseBox(a, b, {}, cancelled), Cancelled);
  }

  void checksSettings() {
    QVERIFY(problems(DenseBoxSettings{}).empty());
    QCOMPARE(problems(DenseBoxSettings{1.0, 0.0, 0.0, -1}).size(), std::size_t{3});
  }
};

QTEST_APPLESS_MAIN(TestDenseBox)
#include "test_dense_box.moc"
