// SPDX-License-Identifier: MIT
#include "relucent/transport/difference.h"

#include <algorithm>
#include <cmath>

#include "relucent/base/error.h"
#include "relucent/base/parallel.h"
#include "relucent/transport/statistics.h"

namespace relucent::transport {
namespace {

using Densities = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

struct NodeDensity {
  std::uint32_t node;
  Densities density;
};

/// Adds `sign` times a row's leaves, as densities per projector pixel.
void addRow(const TransportMatrix& transport, const NodeTable& nodes, std::size_t row, double sign,
            std::vector<NodeDensity>& into) {
  const LeafRow leaves = transport.row(row);
  for (std::size_t entry = 0; entry < leaves.size(); ++entry) {
    std::uint32_t node = leaves.column(entry);
    auto pixels = static_cast<double>(nodes.pixels[node]);
    into.push_back({node, leaves.block(entry).cast<double>() * (sign / pixels)});
  }
}

/// The squared norm over all projector pixels; `row` may name a node more than once.
double squaredNorm(const NodeTable& nodes, std::vector<NodeDensity>& row) {
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
    Densities above = Densities::Zero();
    for (std::uint32_t node = entry.node; nodes.parent[node] != node;) {
      node = nodes.parent[node];
      auto found = std::lower_bound(
          row.begin(), row.end(), node,
          [](const NodeDensity& candidate, std::uint32_t wanted) { return candidate.node < wanted; });
      if (found != row.end() && found->node == node) above += found->density;
    }
    auto pixels = static_cast<double>(nodes.pixels[entry.node]);
    sum += pixels * (entry.density.squaredNorm() + 2.0 * entry.density.cwiseProduct(above).sum());
  }
  return sum;
}

bool areSame(const LeafRow& a, const LeafRow& b) {
  if (!std::ranges::equal(a.columns(), b.columns())) return false;
  for (std::size_t entry = 0; entry < a.size(); ++entry)
    if (a.block(entry) != b.block(entry)) return false;
  return true;
}

/// Finds rows of two matrices that are held alike, in the same codes and groups: most of two of which one
/// became from the other, without working out a value.
class HeldAlike {
 public:
  HeldAlike(const TransportMatrix& a, const TransportMatrix& b)
      : a_(a),
        b_(b),
        any_(a.ownLeaves().sharedColours() && b.ownLeaves().sharedColours() &&
             *a.ownLeaves().sharedColours() == *b.ownLeaves().sharedColours() &&
             a.groups().leaves() == b.groups().leaves() && a.groups().parents() == b.groups().parents()) {}

  bool operator()(std::size_t row) const {
    if (!any_) return false;
    const BlockSparse &a = a_.ownLeaves(), &b = b_.ownLeaves();
    if (!std::ranges::equal(a.columnsOf(row), b.columnsOf(row))) return false;
    for (std::size_t kind = 0; kind < a.sharedColours()->count; ++kind)
      if (a.mixing(row, kind) != b.mixing(row, kind)) return false;
    for (std::size_t projector = 0; !a_.groups().empty() && projector < a_.projectors().devices();
         ++projector)
      if (a_.groups().groupOf(row, projector) != b_.groups().groupOf(row, projector)) return false;
    const std::size_t beginA = a.rowBegin(row), beginB = b.rowBegin(row), count = a.columnsOf(row).size();
    for (std::size_t i = 0; i < count; ++i)
      if (a.factor(beginA + i) != b.factor(beginB + i)) return false;
    return true;
  }

 private:
  const TransportMatrix &a_, &b_;
  bool any_;
};

void requireSameDevices(const TransportMatrix& transport, const TransportMatrix& reference) {
  require(transport.cameras() == reference.cameras() && transport.projectors() == reference.projectors(),
          "only transport between the same devices can be compared");
}

}  // namespace

TransportDifference difference(const TransportMatrix& transport, const TransportMatrix& reference) {
  requireSameDevices(transport, reference);
  std::size_t rows = transport.cameras().count();
  NodeTable nodes(reference.layout());
  std::vector<double> apart(rows), whole(rows);
  parallelFor(0, rows, 64, [&](std::size_t row) {
    std::vector<NodeDensity> entries;
    addRow(reference, nodes, row, 1.0, entries);
    whole[row] = squaredNorm(nodes, entries);
    addRow(transport, nodes, row, -1.0, entries);
    apart[row] = squaredNorm(nodes, entries);
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

CameraMask differingRows(const TransportMatrix& transport, const TransportMatrix& reference) {
  requireSameDevices(transport, reference);
  const std::size_t rows = transport.cameras().count();
  const HeldAlike heldAlike(transport, reference);
  CameraMask differ(rows, 0);
  parallelFor(0, rows, 256, [&](std::size_t row) { differ[row] = heldAlike(row) ? 0 : 1; });
  // The same leaves may be held otherwise, some of them shared, and be summed in another order.
  const std::vector<ColourBlock> sums = transport.rowSums(), referenceSums = reference.rowSums();
  parallelFor(0, rows, 256, [&](std::size_t row) {
    if (differ[row] && sums[row] == referenceSums[row] && areSame(transport.row(row), reference.row(row)))
      differ[row] = 0;
  });
  return differ;
}

}  // namespace relucent::transport
