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

std::string doesNotLookAsPredicted(const ReportVerification& shown, const std::string& when) {
  const std::size_t view = shown.viewThatDiffers.value_or(0);
  if (view == 0)
    return fmt::format(
        "{}: the surface does not look as predicted (ΔE {:.1f}). The camera or the projector may have moved, "
        "or "
        "something on the surface has changed.",
        when, shown.deltaEAfter);
  return fmt::format(
      "{}: for camera {} the surface does not look as predicted (ΔE {:.1f}). That camera or a projector may "
      "have moved, or something on the surface has changed.",
      when, view + 1, shown.others.at(view - 1).deltaEAfter);
}

/// Pictures from one place.
PageData figuresOf(const image::Image& wanted, const image::Image& before, const image::Image& after,
                   double deltaEBefore, double deltaEAfter, const std::optional<double>& predicted) {
  PageData figures(PageData::type::list);
  figures << figure(wanted, "Wanted", "the picture as it should appear.")
          << figure(before, "Photograph, uncompensated", errorText(deltaEBefore, std::nullopt))
          << figure(after, "Photograph, compensated", errorText(deltaEAfter, predicted));
  return figures;
}

void addVerification(const ReportData& data, PageData& warnings, PageData& assurances) {
  const ReportVerification& shown = *data.verification;
  if (shown.isOutOfDate)
    warnings << PageData(fmt::format(
        "The verification photograph, {}, is out of date: what is shown has been measured or chosen "
        "anew since. Another one would prove it.",
        localTime(shown.taken)));
  if (!shown.isAsPredicted) return;
  const std::string when =
      fmt::format("Photographed {}on {}{}", data.isSimulated ? "in the simulation " : "",
                  localTime(shown.taken), shown.picture.empty() ? "" : ", " + shown.picture);
  const std::string change =
      fmt::format("The correction brings the mean colour error ΔE from {:.1f} to {:.1f}", shown.deltaEBefore,
                  shown.deltaEAfter);
  // A later check found something else.
  const bool wasThen = data.drift && data.drift->verdict != acquisition::Verdict::stillGood;
  if (!*shown.isAsPredicted)
    warnings << PageData(doesNotLookAsPredicted(shown, when));
  else if (wasThen)
    assurances << PageData(fmt::format(
        "{}, before the last check for drift: the surface looked as predicted then. {}.", when, change));
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
          "Checked for drift on {}: something has changed, the calibration should be repaired. {}", when,
          figures));
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
  const auto view = [&](const std::string& name, const PageData& figures) {
    PageData one;
    one.set("name", name);
    one.set("isNamed", !shown.others.empty());
    one.set("figures", figures);
    return one;
  };
  PageData views(PageData::type::list);
  views << view("As camera 1 sees it", figuresOf(shown.wanted, shown.before, shown.after, shown.deltaEBefore,
                                                 shown.deltaEAfter, shown.deltaEPredicted));
  for (std::size_t other = 0; other < shown.others.size(); ++other) {
    const ReportVerificationView& seen = shown.others[other];
    views << view(fmt::format("As camera {} sees it", other + 2),
                  figuresOf(seen.wanted, seen.before, seen.after, seen.deltaEBefore, seen.deltaEAfter,
                            seen.deltaEPredicted));
  }
  PageData section;
  section.set("how", data.isSimulated ? "A simulation: projected and photographed by simulated devices"
                                      : "Projected in the venue and photographed");
  section.set("taken", localTime(shown.taken));
  section.set("isOutOfDate", shown.isOutOfDate);
  section.set("views", views);
  return section;
}

void addVerdicts(const ReportData& data, PageData& warnings, PageData& assurances) {
  if (data.verification) addVerification(data, warnings, assurances);
  if (data.drift) addDrift(*data.drift, warnings, assurances);
}

}  // namespace relucent::report
