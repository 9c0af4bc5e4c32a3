// SPDX-License-Identifier: MIT
#include "relucent/report/proof_sections.h"

#include <fmt/format.h>

#include "relucent/report/number_text.h"

namespace relucent::report {
namespace {

std::string errorText(double measured, const std::optional<double>& predicted) {
  std::string text = fmt::format("mean colour error ΔE {:.1f}", measured);
  if (predicted) text += fmt::format(", predicted {:.1f}", *predicted);
  return text + ".";
}

void addVerification(const ReportVerification& shown, PageData& warnings, PageData& assurances) {
  if (!shown.isAsPredicted) return;
  const std::string when = localTime(shown.taken);
  if (*shown.isAsPredicted)
    assurances << PageData(fmt::format(
        "Photographed on {}: the surface looks as predicted. The correction brings the mean colour error ΔE "
        "from {:.1f} to {:.1f}.",
        when, shown.deltaEBefore, shown.deltaEAfter));
  else
    warnings << PageData(fmt::format(
        "Photographed on {}: the surface does not look as predicted (ΔE {:.1f}). The camera or the projector "
        "may have moved.",
        when, shown.deltaEAfter));
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

PageData verificationSection(const ReportVerification& shown) {
  PageData figures(PageData::type::list);
  figures << figure(shown.wanted, "Wanted", "the picture as it should appear.")
          << figure(shown.before, "Photograph, uncompensated", errorText(shown.deltaEBefore, std::nullopt))
          << figure(shown.after, "Photograph, compensated",
                    errorText(shown.deltaEAfter, shown.deltaEPredicted));
  PageData section;
  section.set("taken", localTime(shown.taken));
  section.set("figures", figures);
  return section;
}

void addVerdicts(const ReportData& data, PageData& warnings, PageData& assurances) {
  if (data.verification) addVerification(*data.verification, warnings, assurances);
  if (data.drift) addDrift(*data.drift, warnings, assurances);
}

}  // namespace relucent::report
