// SPDX-License-Identifier: MIT
#include <Eigen/Cholesky>
#include <QtTest>

#include "relucent/base/random.h"
#include "relucent/multiplexing/system_kernels.h"

using namespace relucent;
using namespace relucent::multiplexing;

namespace {

using Symmetric = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

Eigen::MatrixXf randomColumns(Eigen::Index length, Eigen::Index count) {
  Random random{7};
  Eigen::MatrixXf columns =
      Eigen::MatrixXf::Zero(static_cast<Eigen::Index>(padded(static_cast<std::size_t>(length))), count);
  for (Eigen::Index j = 0; j < count; ++j)
    for (Eigen::Index i = 0; i < length; ++i) columns(i, j) = static_cast<float>(random.normal());
  return columns;
}

Symmetric gramOf(const Eigen::MatrixXf& columns, const SystemKernels& kernels) {
  auto count = static_cast<std::size_t>(columns.cols());
  Symmetric gram = Symmetric::Zero(columns.cols(), static_cast<Eigen::Index>(padded(count)));
  kernels.gram(columns.data(), static_cast<std::size_t>(columns.rows()), count, gram.data(), padded(count));
  return gram;
}

}  // namespace

/// Against Eigen in double precision, for every instruction set that this processor has.
class TestSystemKernels : public QObject {
  Q_OBJECT

 private slots:
  void eliminationIsExact_data() {
    QTest::addColumn<int>("kernels");
    QTest::addColumn<int>("equations");
    QTest::addColumn<int>("unknowns");
    for (std::size_t set = 0; set < systemKernels().size(); ++set)
      for (auto [equations, unknowns] : {std::pair{1, 1}, {5, 3}, {16, 8}, {40, 37}, {30, 50}})
        QTest::addRow("%s %dx%d", systemKernels()[set].instructions, equations, unknowns)
            << static_cast<int>(set) << equations << unknowns;
  }
  void eliminationIsExact() {
    QFETCH(int, kernels);
    QFETCH(int, equations);
    QFETCH(int, unknowns);
    const SystemKernels& of = systemKernels()[static_cast<std::size_t>(kernels)];
    Eigen::MatrixXf columns = randomColumns(equations, unknowns);
    Symmetric system = gramOf(columns, of);
    Eigen::MatrixXd exact = columns.cast<double>().transpose() * columns.cast<double>();
    exact.diagonal().array() += 1.0;
    system.diagonal().array() += 1.0f;

    // Half of the unknowns: the rest is the Schur complement.
    Eigen::Index half = (unknowns + 1) / 2, rest = unknowns - half;
    Symmetric part = system;
    auto stride = static_cast<std::size_t>(system.cols()), order = static_cast<std::size_t>(unknowns);
    of.eliminate(part.data(), stride, order, static_cast<std::size_t>(half));
    // Eigen's solver takes the address of the first of no columns.
    Eigen::MatrixXd schur = exact.bottomRightCorner(rest, rest);
    if (rest > 0)
      schur -= exact.bottomLeftCorner(rest, half) *
               exact.topLeftCorner(half, half).llt().solve(exact.topRightCorner(half, rest));
    for (Eigen::Index i = 0; i < rest; ++i)
      for (Eigen::Index j = i; j < rest; ++j)
        // Sums of some hundred products of size 1 in single precision.
        QVERIFY(std::abs(static_cast<double>(part(half + i, half + j)) - schur(i, j)) < 1e-4 * equations);

    of.eliminate(system.data(), stride, order, order);
    Symmetric inverse = Symmetric::Zero(unknowns, system.cols());
    of.invert(system.data(), stride, order, inverse.data());
    Eigen::MatrixXd upper = inverse.leftCols(unknowns).cast<double>().triangularView<Eigen::Upper>();
    Eigen::MatrixXd pivots = system.diagonal().head(unknowns).cast<double>().asDiagonal();
    QVERIFY((upper * pivots * upper.transpose() * exact - Eigen::MatrixXd::Identity(unknowns, unknowns))
                .cwiseAbs()
                .maxCoeff() < 1e-3);
  }

  void sumsFollowTheirEquations_data() {
    QTest::addColumn<int>("kernels");
    for (std::size_t set = 0; set < systemKernels().size(); ++set)
      QTest::addRow("%s", systemKernels()[set].instructions) << static_cast<int>(set);
  }
  void sumsFollowTheirEquations() {
    QFETCH(int, kernels);
    const SystemKernels& of = systemKernels()[static_cast<std::size_t>(kernels)];
    const Eigen::MatrixXf values = randomColumns(48, 8);
    const std::size_t length = 48;
    const std::array<const float*, 3> design{values.col(0).data(), values.col(1).data(),
                                             values.col(2).data()};
    const Eigen::MatrixXf colours = values.leftCols(3);
    auto near = [](const auto& a, const auto& b) { return (a - b).cwiseAbs().maxCoeff() < 1e-4f; };

    float variation = of.variation(design[0], length);
    QVERIFY(std::abs(variation - (values.col(0).array() - 0.5f).square().sum()) < 1e-3f);

    Eigen::VectorXf light = values.col(3), square = values.col(4);
    of.gather(design[0], length, 2.0f, light.data(), 3.0f, square.data());
    QVERIFY(near(light, values.col(3) + 2.0f * values.col(0)));
    QVERIFY(near(square.array(), values.col(4).array() + 3.0f * (values.col(0).array() - 0.5f).square()));

    const Eigen::Vector3f mixing(0.5f, -0.3f, 0.8f);
    Eigen::VectorXf column = values.col(5), left = values.col(6);
    of.weigh(design, length, {mixing[0], mixing[1], mixing[2]}, values.col(7).data(), 0.7f, column.data(),
             0.4f, left.data());
    const Eigen::VectorXf shown = values.col(7).cwiseProduct(colours * mixing);
    QVERIFY(near(column, 0.7f * shown));
    QVERIFY(near(left, values.col(6) - 0.4f * shown));

    const Eigen::Matrix<float, 3, 3, Eigen::RowMajor> block = values.block<3, 3>(0, 5);
    Eigen::MatrixXf lights = values.middleCols(3, 3);
    of.relight(design, length, block.data(),
               {lights.col(0).data(), lights.col(1).data(), lights.col(2).data()});
    QVERIFY(near(lights, values.middleCols(3, 3) + colours * block.transpose()));
  }

  /// Rounding cannot make a pivot smaller than its prior.
  void pivotsStayAbovePriors() {
    Eigen::MatrixXf columns = randomColumns(8, 1).replicate(1, 12) * 3e4f;
    for (const SystemKernels& kernels : systemKernels()) {
      Symmetric system = gramOf(columns, kernels);
      system.diagonal().array() += 1.0f;
      kernels.eliminate(system.data(), static_cast<std::size_t>(system.cols()), 12, 12);
      QVERIFY(system.diagonal().head(12).minCoeff() >= 1.0f);
      QVERIFY(system.allFinite());
    }
  }
};

QTEST_MAIN(TestSystemKernels)
#include "test_system_kernels.moc"
