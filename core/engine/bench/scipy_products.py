# SPDX-License-Identifier: MIT
"""Times SciPy's CSR product with an operator that the engine benchmark wrote.

    python3 scipy_products.py FOLDER there|both wall|thread

FOLDER holds `start`, `column` (32-bit integers) and `value` (32-bit floats) of compressed rows, and `shape` with two
numbers. `both` times the product and the transposed one, as a step needs them. Prints the median and the best
seconds of the runs; says so on standard error and ends with 3 where SciPy is missing."""

import sys
import time
from pathlib import Path

try:
    import numpy
    import scipy.sparse
except ImportError as missing:
    print(missing, file=sys.stderr)
    sys.exit(3)

FEWEST, MOST, ENOUGH = 5, 60, 0.5  # as timedRuns() of the benchmark


def operator(folder):
    rows, columns = (int(n) for n in (folder / "shape").read_text().split())
    arrays = [numpy.fromfile(folder / name, dtype) for name, dtype in
              (("value", numpy.float32), ("column", numpy.int32), ("start", numpy.int32))]
    return scipy.sparse.csr_matrix(tuple(arrays), shape=(rows, columns), copy=False)


def main():
    folder, what, clock = Path(sys.argv[1]), sys.argv[2], sys.argv[3]
    now = time.thread_time if clock == "thread" else time.perf_counter
    matrix = operator(folder)
    light = numpy.random.default_rng(1).random(matrix.shape[1], dtype=numpy.float32)

    def run():
        begin = now()
        seen = matrix @ light
        if what == "both":
            matrix.T @ seen
        return now() - begin

    run()
    seconds = []
    while len(seconds) < FEWEST or (sum(seconds) < ENOUGH and len(seconds) < MOST):
        seconds.append(run())
    seconds.sort()
    print(seconds[len(seconds) // 2], seconds[0])


main()
