// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/SparseCore>
#include <optional>
#include <string>

#include "relucent/engine/bench/engine_bench.h"

namespace relucent::engine {

/// One colour channel of an operator in compressed rows.
using ReferencePlane = Eigen::SparseMatrix<float, Eigen::RowMajor, int>;

enum class ReferenceProduct {
  there,  // y = A x
  both,   // y = A x and A^T y, as in a step
};

/// Eigen's and SciPy's compressed rows of M and of the packed T as single floats, one thread; their three
/// channels one after the other, T's without mixing. `result.notes` says what is missing.
void benchReferences(const EngineVenue& engine, bool oneThread, const std::function<double()>& clock,
                     EngineBenchResult& result);

/// SciPy's product with a plane, by the system's Python; empty without SciPy.
/// `oneThread`: CPU seconds instead of wall-clock time.
/// Throws: Error{disk} if the plane cannot be written.
std::optional<EngineBenchTiming> timeSciPy(const ReferencePlane& plane, ReferenceProduct product,
                                           bool oneThread);

}  // namespace relucent::engine
