// SPDX-License-Identifier: MIT
#include "relucent/report/report.h"

#include "relucent/base/file.h"
#include "relucent/base/require.h"
#include "relucent/report/page.h"
#include "relucent/report/templates.h"

namespace relucent::report {

std::string reportHtml(const ReportData& data) {
  kainjow::mustache::mustache page{std::string(templates::page)};
  std::string html = page.render(pageOf(data));
  require(page.is_valid(), "page.html: {}", page.error_message());
  return html;
}

void writeReport(const std::filesystem::path& path, const ReportData& data) {
  writeFileAtomically(path, reportHtml(data));
}

}  // namespace relucent::report
