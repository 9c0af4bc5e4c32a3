// SPDX-License-Identifier: MIT
#include <Eigen/Core>
#include <QtTest>
#include <new>

#include "relucent/base/matrix_size.h"

using namespace relucent;

class TestMatrixSize : public QObject {
  Q_OBJECT

 private slots:
  void whatIsUsedAgainHasItsSize() {
    Eigen::MatrixXf matrix = Eigen::MatrixXf::Ones(3, 4);
    for (const auto& [rows, columns] :
         {std::pair<Eigen::Index, Eigen::Index>(4, 3), {3, 4}, {50, 2}, {0, 5}}) {
      sizeTo(matrix, rows, columns);
      QCOMPARE(matrix.rows(), rows);
      QCOMPARE(matrix.cols(), columns);
      matrix.setZero();
    }
    Eigen::VectorXf vector;
    sizeTo(vector, 7);
    QCOMPARE(vector.size(), Eigen::Index{7});
    Eigen::ArrayX3f array(2, 3);
    sizeTo(array, 5, 3);
    QCOMPARE(array.rows(), Eigen::Index{5});
  }

  /// Law: what there is no memory for is empty, and can be used again and destroyed.
  void withoutMemoryItIsEmpty() {
    // Squared, of floats, these are more bytes than a number holds: no allocator is asked, which a
    // sanitizer's would not survive.
    constexpr Eigen::Index most = Eigen::Index{1} << 31;
    Eigen::MatrixXf matrix = Eigen::MatrixXf::Ones(300, 400);
    QVERIFY_THROWS_EXCEPTION(std::bad_alloc, sizeTo(matrix, most, most));
    QCOMPARE(matrix.size(), Eigen::Index{0});
    QVERIFY(matrix.data() == nullptr);
    sizeTo(matrix, 2, 2);
    matrix.setOnes();
    QCOMPARE(matrix.sum(), 4.0f);
    QVERIFY_THROWS_EXCEPTION(std::bad_alloc, sizeTo(matrix, most, most));
  }
};

QTEST_APPLESS_MAIN(TestMatrixSize)
#include "test_matrix_size.moc"
