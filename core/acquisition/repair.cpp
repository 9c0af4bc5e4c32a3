// SPDX-License-Identifier: MIT
#include "acquisition/repair.h"

#include <fmt/format.h>

#include <algorithm>

namespace relucent {
namespace {

constexpr int mostRepairs = 2;

std::size_t countOf(const std::vector<std::uint8_t>& flags) {
  return static_cast<std::size_t>(std::count(flags.begin(), flags.end(), 1));
}

void adoptVerification(Acquisition& result, Verification verification) {
  result.verificationError = errorOf(verification.rows);
  result.flagged = std::move(verification.flagged);
  result.residual = std::move(verification.residual);
}

/// `first`, with the rows of `second` that are chosen.
BlockSparse mixed(const BlockSparse& first, const BlockSparse& second,
                  const std::vector<std::uint8_t>& chosen, const References& references) {
  BlockSparseWriter writer(first.columns(), references.fullScale, first.blocks());
  for (std::size_t row = 0; row < first.rows(); ++row) {
    const BlockSparse& from = chosen[row] ? second : first;
    for (std::size_t entry = from.rowBegin(row); entry < from.rowBegin(row + 1); ++entry)
      writer.add(from.column(entry), from.code(entry));
    writer.endRow();
  }
  return writer.build();
}

void replaceRows(Stack& into, const Stack& from, const std::vector<std::uint8_t>& chosen) {
  for (std::size_t i = 0; i < into.size(); ++i)
    if (chosen[i / 3]) into[i] = from[i];
}

}  // namespace

void verifyOnly(Acquisition& result, Watch& watch, const References& references,
                const AcquisitionSettings& settings, Progress& progress) {
  adoptVerification(result,
                    verify(result.transport, watch, references, settings, references.usable, 0, progress));
}

void verifyAndRepair(Acquisition& result, Watch& watch, const References& references, const Scheme& scheme,
                     const AcquisitionSettings& settings, Progress& progress) {
  Progress firstPart = progress.part(0.5, "test patterns");
  Verification before =
      verify(result.transport, watch, references, settings, references.usable, 0, firstPart);
  std::vector<Residual> rows = before.rows;
  adoptVerification(result, std::move(before));

  for (int repair = 1; repair <= mostRepairs; ++repair) {
    std::vector<std::uint8_t> flagged = result.flagged;
    std::size_t ill = countOf(flagged);
    if (ill == 0) return;
    result.remeasured += repair == 1 ? static_cast<int>(ill) : 0;
    Progress part = progress.part(0.25, fmt::format("measuring {} flagged pixels again", ill));
    Tree tree = plantedTree(watch.projectors(), references, flagged);
    if (growTree(tree, watch, references, scheme, false, part)) throw KeepAndStop();
    Stack leafVariance = leafVarianceOf(tree);
    BlockSparse again = harvest(tree, references);
    auto with = [&](const std::vector<std::uint8_t>& chosen) {
      return TransportMatrix(watch.cameras(), watch.projectors(),
                             mixed(result.transport.leaves(), again, chosen, references));
    };
    Verification after = verify(with(flagged), watch, references, settings, flagged,
                                repair * settings.verificationPatterns, part);
    watch.check(part);

    std::vector<std::uint8_t> better(flagged.size(), 0);
    for (std::size_t row = 0; row < flagged.size(); ++row)
      better[row] = flagged[row] && after.rows[row].relative() < rows[row].relative() ? 1 : 0;
    result.transport = with(better);
    replaceRows(result.leafVariance, leafVariance, better);
    for (std::size_t size = 0; size < result.residual.size(); ++size)
      replaceRows(result.residual[size], after.residual[size], better);
    for (std::size_t row = 0; row < flagged.size(); ++row) {
      if (!better[row]) continue;
      rows[row] = after.rows[row];
      result.flagged[row] = after.flagged[row];
    }
    result.verificationError = errorOf(rows);
    if (2 * countOf(result.flagged) > ill) return;
  }
}

}  // namespace relucent
