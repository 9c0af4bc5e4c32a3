// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "relucent/acquisition/dense_photographs.h"
#include "relucent/multiplexing/rows.h"
#include "relucent/transport/draft.h"

namespace relucent::acquisition {

/// What dense patterns have said so far, without solving anything again:
///   T_jck ~ F_c x_j b_ck / sum over j and k of the same,
/// the light of each leaf divided as in near or in far light of its row. Colours of single leaves are left
/// out. Coarsened so that the cameras have at most some 160x120 pixels together.
/// `level`: of the patterns shown last.  Shapes: a row for each camera pixel.
transport::Draft draftOf(const multiplexing::Rows& rows, const DensePhotographs& photographs,
                         const photography::References& references, const transport::NodeLayout& layout,
                         int level);

/// By how many levels such a draft is coarsened.
int draftCoarsening(const Rasters& cameras);

}  // namespace relucent::acquisition
