// SPDX-License-Identifier: MIT
#include "relucent/acquisition/repair.h"

#include <fmt/format.h>

#include <algorithm>

#include "relucent/acquisition/growth.h"
#include "relucent/acquisition/mixed_rows.h"
#include "relucent/acquisition/verification.h"
#include "relucent/base/message.h"

namespace relucent::acquisition {
namespace {

constexpr int mostRepairs = 2;
// Where more of the camera pixels in use than this are wrong it is not they that were disturbed: the camera
// was moved, or T is wrong as a whole. Measuring them all again by a tree takes thousands of photographs.
constexpr double mostFlagged = 0.2;

std::size_t countOf(const std::vector<std::uint8_t>& flags) {
  return static_cast<std::size_t>(std::count(flags.begin(), flags.end(), 1));
}

void adoptVerification(VerifiedTransport& verified, const Verification& verification) {
  verified.error = errorOf(verification.rows);
  verified.flagged = verification.flagged;
  verified.residual = verification.residual;
}

/// Rounds of measuring flagged camera pixels again.
class Repair {
 public:
  /// `rows`: what the first verification found. Keeps references: all but `rows` outlive it.
  Repair(VerifiedTransport& verified, std::vector<Residual> rows, const TreeContext& context,
         const AcquisitionSettings& settings)
      : verified_(verified), rows_(std::move(rows)), context_(context), settings_(settings) {}

  std::optional<sentinels::Interruption> run(Progress& progress) {
    const auto used = static_cast<double>(countOf(context_.references().usable));
    const double least = context_.scheme.repairedFrom * used, most = mostFlagged * used;
    for (int round = 1; round <= mostRepairs; ++round) {
      std::size_t ill = countOf(verified_.flagged);
      if (ill == 0 || static_cast<double>(ill) < least || static_cast<double>(ill) > most) break;
      verified_.remeasured += round == 1 ? static_cast<int>(ill) : 0;
      Progress part = progress.part(0.25, RELUCENT_PLURAL_MESSAGE("stage.remeasuring-flagged-pixels",
                                                                  "measuring {} flagged pixels again",
                                                                  "measuring {} flagged pixel again")
                                              .with(ill));
      if (auto interrupted = repair(round, part)) return interrupted;
      if (2 * countOf(verified_.flagged) > ill) break;
    }
    return std::nullopt;
  }

 private:
  std::optional<sentinels::Interruption> repair(int round, Progress& part) {
    const CameraMask flagged = verified_.flagged;
    Tree tree = emptyTree(context_.references(), flagged);
    sentinels::AcquisitionObserver nobody;  // is to hear of the whole tree alone
    if (auto interrupted = growTree(tree, {context_.watch, context_.scheme, nobody}, false, part))
      return interrupted;
    CameraStack leafVariance = leafVarianceOf(tree);
    transport::BlockSparse again = takeLeaves(tree, context_.references());
    sentinels::Interruptible<Verification> after = verify(
        with(again, flagged), context_, {settings_, flagged, round * settings_.verificationPatterns}, part);
    if (!after) return after.interruption();
    if (auto interrupted = context_.watch.check(part)) return interrupted;

    std::vector<std::uint8_t> better(flagged.size(), 0);
    for (std::size_t row = 0; row < flagged.size(); ++row)
      better[row] = flagged[row] && after->rows[row].relative() < rows_[row].relative() ? 1 : 0;
    verified_.transport = with(again, better);
    replaceRows(verified_.leafVariance, leafVariance, better);
    adopt(*after, better);
    return std::nullopt;
  }

  transport::TransportMatrix with(const transport::BlockSparse& again,
                                  const std::vector<std::uint8_t>& chosen) const {
    const photography::References& references = context_.references();
    return mixedRows(verified_.transport,
                     transport::TransportMatrix(references.cameras, references.projectors, again), chosen);
  }

  void adopt(const Verification& after, const std::vector<std::uint8_t>& better) {
    for (std::size_t size = 0; size < verified_.residual.size(); ++size)
      replaceRows(verified_.residual[size], after.residual[size], better);
    for (std::size_t row = 0; row < better.size(); ++row) {
      if (!better[row]) continue;
      rows_[row] = after.rows[row];
      verified_.flagged[row] = after.flagged[row];
    }
    verified_.error = errorOf(rows_);
  }

  VerifiedTransport& verified_;
  std::vector<Residual> rows_;
  const TreeContext& context_;
  const AcquisitionSettings& settings_;
};

}  // namespace

std::optional<sentinels::Interruption> verifyOnly(VerifiedTransport& verified, const TreeContext& context,
                                                  const AcquisitionSettings& settings, Progress& progress) {
  sentinels::Interruptible<Verification> found =
      verify(verified.transport, context, {settings, context.references().usable}, progress);
  if (!found) return found.interruption();
  adoptVerification(verified, *found);
  return std::nullopt;
}

std::optional<sentinels::Interruption> verifyAndRepair(VerifiedTransport& verified,
                                                       const TreeContext& context,
                                                       const AcquisitionSettings& settings,
                                                       Progress& progress) {
  Progress firstPart = progress.part(0.5, RELUCENT_MESSAGE("stage.test-patterns", "test patterns"));
  sentinels::Interruptible<Verification> found =
      verify(verified.transport, context, {settings, context.references().usable}, firstPart);
  if (!found) return found.interruption();
  adoptVerification(verified, *found);
  return Repair(verified, found->rows, context, settings).run(progress);
}

}  // namespace relucent::acquisition
