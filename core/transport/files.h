// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include "transport/block_sparse.h"
#include "transport/expansion.h"

namespace relucent {

/// A block matrix as scipy.sparse.save_npz writes a BSR matrix with 3x3 blocks: a zip file of the arrays
/// `data` (blocks, 3, 3) float32, `indices` and `indptr` int32 (int64 where needed), `shape` (3 rows,
/// 3 columns) int64 and `format` "bsr". An array of ours more, `scale` (rows) float32, brings back the same
/// bits; SciPy does not mind it, and files without it are read too.
/// Not compressed: the numbers are noise in their lower bits.
/// Throws: Error{disk}; what stood at `path` before is then untouched.
void writeNpz(const std::filesystem::path& path, const BlockSparse& matrix);
/// The same for a matrix with a column for every projector pixel; without `scale`.
void writeNpz(const std::filesystem::path& path, const PixelMatrix& matrix);

/// Throws: Error{disk} if unreadable; Error{format} if foreign, damaged, cut short or inconsistent.
BlockSparse readNpz(const std::filesystem::path& path);

}  // namespace relucent
