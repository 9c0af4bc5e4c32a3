// SPDX-License-Identifier: MIT
#include "transport/difference.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/parallel.h"

namespace relucent {
namespace {

using Densities = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

struct NodeDensity {
  std::uint32_t node;
  Densities density;
};

/// Adds `sign` times a row's leaves, as densities per projector pixel.
void addRow(const TransportMatrix& transport, std::size_t row, double sign, std::vector<NodeDensity>& into) {
  const BlockSparse& leaves = transport.leaves();
  const NodeLayout& layout = transport.layout();
  for (std::size_t entry = leaves.rowBegin(row); entry < leaves.rowBegin(row + 1); ++entry) {
    std::uint32_t node = leaves.column(entry);
    double pixels = layout.block(layout.node(node)).count();
    into.push_back({node, leaves.block(row, entry).cast<double>() * (sign / pixels)});
  }
}

/// The squared norm over all projector pixels; `row` may name a node more than once.
double squaredNorm(const NodeLayout& layout, std::vector<NodeDensity>& row) {
  std::sort(row.begin(), row.end(), [](const auto& a, const auto& b) { return a.node < b.node; });
  std::size_t count = 0;
  for (std::size_t i = 0; i < row.size(); ++i) {
    if (count > 0 && row[count - 1].node == row[i].node)
      row[count - 1].density += row[i].density;
    else
      row[count++] = row[i];
  }
  row.resize(count);

  double sum = 0.0;
  for (const NodeDensity& entry : row) {
    Node node = layout.node(entry.node);
    double pixels = layout.block(node).count();
    Densities above = Densities::Zero();
    int levels = layout.levels(static_cast<std::size_t>(node.projector));
    for (Node ancestor = node; ancestor.level + 1 < levels;) {
      ancestor = layout.parent(ancestor);
      auto index = static_cast<std::uint32_t>(layout.index(ancestor));
      auto found = std::lower_bound(
          row.begin(), row.end(), index,
          [](const NodeDensity& candidate, std::uint32_t wanted) { return candidate.node < wanted; });
      if (found != row.end() && found->node == index) above += found->density;
    }
    sum += pixels * (entry.density.squaredNorm() + 2.0 * entry.density.cwiseProduct(above).sum());
  }
  return sum;
}

}  // namespace

TransportDifference difference(const TransportMatrix& transport, const TransportMatrix& reference) {
  require(transport.cameras() == reference.cameras() && transport.projectors() == reference.projectors(),
          "only transport between the same devices can be compared");
  std::size_t rows = transport.leaves().rows();
  std::vector<double> apart(rows);
  std::vector<double> whole(rows);
  parallelFor(0, rows, 64, [&](std::size_t row) {
    std::vector<NodeDensity> entries;
    addRow(reference, row, 1.0, entries);
    whole[row] = squaredNorm(reference.layout(), entries);
    addRow(transport, row, -1.0, entries);
    apart[row] = squaredNorm(reference.layout(), entries);
  });

  TransportDifference result;
  double apartSum = 0.0;
  double wholeSum = 0.0;
  std::vector<double> rowErrors;
  for (std::size_t row = 0; row < rows; ++row) {
    apartSum += apart[row];
    wholeSum += whole[row];
    // Rounding can leave a tiny negative square where two rows agree.
    if (whole[row] > 0.0) rowErrors.push_back(std::sqrt(std::max(0.0, apart[row]) / whole[row]));
  }
  if (wholeSum > 0.0) result.frobenius = std::sqrt(std::max(0.0, apartSum) / wholeSum);
  result.rows = rowErrors.size();
  if (rowErrors.empty()) return result;
  std::sort(rowErrors.begin(), rowErrors.end());
  result.rowMedian = rowErrors[rowErrors.size() / 2];
  result.rowP95 = rowErrors[rowErrors.size() * 95 / 100];
  return result;
}

}  // namespace relucent
