#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Makes box_least_squares.json: least squares in the box [0, 1], solved by SciPy's lsq_linear, for the tests of
the solvers to agree with. Needs python3-scipy. Run by hand when a case is added:

    /usr/bin/python3 tests/data/box_least_squares.py

Matrices are whole numbers, to be divided by 32767: that is how a light transport matrix stores a row whose
largest value is one, so the same numbers serve dense and sparse solvers without a rounding between.
"""
import json
from pathlib import Path

import numpy
import scipy
from scipy.optimize import lsq_linear

FULL_SCALE = 32767


def coded(matrix):
    return numpy.rint(numpy.clip(matrix, -1, 1) * FULL_SCALE).astype(int)


def solved(name, codes, b, weight=None):
    """A case; `unique` where the columns are independent, so that x has to agree and not f alone."""
    a = codes / FULL_SCALE
    root = numpy.sqrt(numpy.ones(len(b)) if weight is None else weight)
    weighted = root[:, None] * a
    result = lsq_linear(weighted, root * b, (0, 1), method="bvls", tol=1e-14, max_iter=10000)
    check = lsq_linear(weighted, root * b, (0, 1), method="trf", tol=1e-14, max_iter=10000)
    assert abs(result.cost - check.cost) < 1e-9 * (1 + result.cost), (name, result.cost, check.cost)
    return {
        "name": name,
        "rows": a.shape[0],
        "columns": a.shape[1],
        "codes": codes.ravel().tolist(),
        "b": b.tolist(),
        "x": result.x.tolist(),
        "objective": result.cost,
        "unique": bool(numpy.linalg.matrix_rank(weighted) == a.shape[1]),
    }


def dense_cases(random):
    tall = random.uniform(-1, 1, (30, 12))
    wide = random.uniform(-1, 1, (8, 20))
    twins = tall.copy()
    twins[:, 5] = twins[:, 2]
    empty_column = tall.copy()
    empty_column[:, 4] = 0
    # Singular values from 1 down to 1e-3.
    u, _, v = numpy.linalg.svd(random.normal(size=(40, 16)), full_matrices=False)
    steep = u @ numpy.diag(numpy.logspace(0, -3, 16)) @ v
    inside = coded(tall) / FULL_SCALE @ random.uniform(0.2, 0.8, 12)
    yield solved("tall", coded(tall), 2 * random.normal(size=30))
    yield solved("solution inside the box", coded(tall), inside)
    yield solved("everything at its limits", coded(tall), 50 * random.normal(size=30))
    yield solved("wide", coded(wide), random.normal(size=8))
    yield solved("two equal columns", coded(twins), random.normal(size=30))
    yield solved("a column of zeros", coded(empty_column), random.normal(size=30))
    yield solved("singular values from 1 to 1e-3", coded(steep), random.normal(size=40))
    yield solved("one unknown", coded(random.uniform(size=(3, 1))), numpy.array([0.3, 0.2, 0.1]))
    yield solved("one equation", coded(random.uniform(size=(1, 3))), numpy.array([0.7]))


def transport_case(random, name, camera, projector, negative):
    """A light transport: non-negative but for noise, brightest on the blocks' diagonals."""
    cameras, projectors = numpy.prod(camera), numpy.prod(projector)
    blocks = random.uniform(0, 1, (cameras, 3, projectors, 3)) ** 3
    blocks *= numpy.where(numpy.eye(3)[None, :, None, :] > 0, 1.0, 0.2)
    blocks -= negative * random.uniform(0, 1, blocks.shape)
    codes = coded(blocks.reshape(3 * cameras, 3 * projectors))
    # What is wanted lies partly beyond what can be had, on both sides.
    b = (codes / FULL_SCALE).sum(axis=1) * random.uniform(-0.2, 1.3, 3 * cameras)
    weight = random.uniform(0.2, 1.2, cameras)
    case = solved(name, codes, b, numpy.repeat(weight, 3))
    case.update(camera=list(camera), projector=list(projector), weight=weight.tolist())
    return case


def transport_cases(random):
    yield transport_case(random, "more camera pixels", (4, 3), (3, 2), 0.0)
    yield transport_case(random, "as many camera pixels", (5, 1), (1, 5), 0.0)
    yield transport_case(random, "negative noise", (4, 4), (2, 3), 0.1)
    yield transport_case(random, "fewer camera pixels", (2, 2), (3, 2), 0.0)
    yield transport_case(random, "one pixel each", (1, 1), (1, 1), 0.0)


if __name__ == "__main__":
    random = numpy.random.default_rng(2007)
    document = {
        "scipy": scipy.__version__,
        "dense": list(dense_cases(random)),
        "transport": list(transport_cases(random)),
    }
    Path(__file__).with_suffix(".json").write_text(json.dumps(document) + "\n")
