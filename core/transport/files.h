// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include "relucent/base/fingerprint.h"
#include "relucent/transport/expansion.h"
#include "relucent/transport/transport_matrix.h"

namespace relucent::transport {

/// Block matrices are stored in SciPy's format, as scipy.sparse.save_npz writes a BSR matrix of 3x3 blocks,
/// so that scipy.sparse.load_npz reads them:
///   data (n, 3, 3) float32 or int16, indices (n), indptr (rows + 1), shape (3 rows, 3 columns), format
///   b'bsr',
/// and additionally `scale` (rows) float32, the rows' quantisation steps, which make saving and loading give
/// the same bits, and for a light transport `cameras` and `projectors` (devices, 2), their sizes.
/// Indices are 64-bit where 32 bits are too few.
///
/// Shared colours, as they are, have the format b'relucent-shared-colours' instead, which SciPy does not
/// know:
///   factor (n, 3) int16, indices (n), indptr (rows + 1), mixing (rows, kinds, 3, 3) float32, kinds (ranges,
///   2): the end of each range of columns, and its kind;   block = mixing[row, kind] @ diag(factor[block]).
/// Leaves that camera pixels share, beside those, have the format b'relucent-shared-leaves' and
///   group_factor, group_indices, group_indptr: a row for each group;  group_parent (groups): the next wider
///   one, or -1;  group_of (camera pixels, projectors): the group, or -1.
/// Source: core/transport/README.md.

/// Atomically. Throws: Error{disk}.
void saveBlocks(const std::filesystem::path& path, const BlockSparse& blocks);
/// Files without `scale` (saved by SciPy) are quantised to each row's largest value.
/// Throws: Error{disk}; Error{format} if anything is missing, damaged or inconsistent; Error{memory}.
BlockSparse loadBlocks(const std::filesystem::path& path);

/// How the values of blocks are written: as numbers for every reader, or as codes, the 16-bit fixed-point
/// values that a BlockSparse holds: own colours (int16; value = scale[row] * code) in little more than half
/// of the bytes, which SciPy opens too; shared colours in a quarter.
enum class StoredValues { floats, codes };

/// T' with its devices; columns are the nodes of NodeLayout. Errors as above.
void saveTransport(const std::filesystem::path& path, const TransportMatrix& transport,
                   StoredValues values = StoredValues::floats);
TransportMatrix loadTransport(const std::filesystem::path& path);

/// Adds all that saveTransport() would write. At the speed of memory.
void addTo(Fingerprint& fingerprint, const TransportMatrix& transport);

/// T with a column for every projector pixel, for other programs. Errors as above.
void saveExpanded(const std::filesystem::path& path, const PixelExpansion& expansion);

}  // namespace relucent::transport
