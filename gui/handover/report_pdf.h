// SPDX-License-Identifier: MIT
#pragma once

#include <QString>

namespace relucent {

/// Writes the report of core/pipeline/report.h on pages of A4, for people who hand over paper: the same
/// texts, pictures, charts and tables in the same order, black on white. May be called on any thread.
/// `html`: what reportHtml() says; well-formed, pictures and charts within.
/// Throws: Error{format} if it is not; Error{disk}.
void writeReportPdf(const QString& html, const QString& file);

}  // namespace relucent
