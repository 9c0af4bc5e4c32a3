// SPDX-License-Identifier: MIT
#pragma once

namespace relucent {

/// Gives one of Eigen's matrices or arrays another size; what it held is lost. If there is no memory for
/// that, it is empty: after Eigen 3.4's own resize() it holds what it has freed, and frees it once more in
/// the end. For what is used again and again; new objects have nothing to free. Throws: std::bad_alloc.
template <typename Matrix>
void sizeTo(Matrix& matrix, decltype(Matrix().rows()) rows, decltype(Matrix().cols()) columns = 1) {
  if (matrix.size() != rows * columns) {
    Matrix none;
    matrix.swap(none);
  }
  matrix.resize(rows, columns);
}

}  // namespace relucent
