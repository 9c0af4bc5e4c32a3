// SPDX-License-Identifier: MIT
#include "relucent/report/proof_sections.h"

#include <fmt/format.h>

#include "relucent/pipeline/prove.h"
#include "relucent/report/number_text.h"

namespace relucent::report {
namespace {

std::string errorText(double measured, const std::optional<double>& predicted) {
  std::string text = fmt::format("mean colour error ΔE {:.1f}", measured);
  if (predicted) text += fmt::format(", predicted {:.1f}", *predicted);
  return text + ".";
}

void addVerification(const ReportData& data, PageData& warnings, PageData& assurances) {
  const ReportVerification& shown = *data.verification;
  if (!shown.isAsPredicted) return;
  const std::string when = fmt::format("Photographed {}on {}", data.isSimulated ? "in the simulation " : "",
                                       localTime(shown.taken));
  const std::string change =
      fmt::format("The correction brings the mean colour error ΔE from {:.1f} to {:.1f}", shown.deltaEBefore,
                  shown.deltaEAfter);
  if (!*shown.isAsPredicted)
    warnings << PageData(
        fmt::format("{}: the surface does not look as predicted (ΔE {:.1f}). The camera or the projector "
                    "may have moved.",
                    when, shown.deltaEAfter));
  else if (shown.deltaEAfter >= pipeline::plainDeltaE)
    warnings << PageData(
        fmt::format("{}: the surface looks as predicted, but errors are plain to see. {}.", when, change));
  else
    assurances << PageData(fmt::format("{}: the surface looks as predicted. {}.", when, change));
}

void addDrift(const ReportDrift& drift, PageData& warnings, PageData& assurances) {
  const std::string when = localTime(drift.checked);
  const std::string figures =
      fmt::format("The test patterns are predicted to within {}, when measured {}; {} of the view changed.",
                  percent(drift.error), percent(drift.errorThen), percent(drift.changedShare));
  switch (drift.verdict) {
    case acquisition::Verdict::stillGood:
      assurances << PageData(
          fmt::format("Checked for drift on {}: the measurement still holds. {}", when, figures));
      break;
    case acquisition::Verdict::remeasure:
      warnings << PageData(fmt::format(
          "Checked for drift on {}: something has changed, the light transport should be measured again. {}",
          when, figures));
      break;
    case acquisition::Verdict::startAgain:
      warnings << PageData(
          fmt::format("Checked for drift on {}: hardly anything fits. Camera or projector have moved; "
                      "everything should be "
                      "measured again. {}",
                      when, figures));
      break;
  }
}

}  // namespace

PageData verificationSection(const ReportData& data) {
  const ReportVerification& shown = *data.verification;
  PageData figures(PageData::type::list);
  figures << figure(shown.wanted, "Wanted", "the picture as it should appear.")
          << figure(shown.before, "Photograph, uncompensated", errorText(shown.deltaEBefore, std::nullopt))
          << figure(shown.after, "Photograph, compensated",
                    errorText(shown.deltaEAfter, shown.deltaEPredicted));
  PageData section;
  section.set("how", data.isSimulated ? "A simulation: projected and photographed by simulated devices"
                                      : "Projected in the venue and photographed");
  section.set("taken", localTime(shown.taken));
  section.set("figures", figures);
  return section;
}

void addVerdicts(const ReportData& data, PageData& warnings, PageData& assurances) {
  if (data.verification) addVerification(data, warnings, assurances);
  if (data.drift) addDrift(*data.drift, warnings, assurances);
}

}  // namespace relucent::report
