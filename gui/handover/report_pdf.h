// SPDX-License-Identifier: MIT
#pragma once

#include <QString>

namespace relucent::gui {

/// Writes the report of core/report/report.h as PDF on A4 pages: the same texts, pictures, charts and
/// tables in the same order, black on white. May be called on any thread. `html`: the result of reportHtml();
/// well-formed, with embedded pictures and charts.
/// Throws: Error{format} if it is not; Error{disk}.
void writeReportPdf(const QString& html, const QString& file);

}  // namespace relucent::gui
